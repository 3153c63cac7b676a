import L from "leaflet";

/** A Leaflet map of the world that leaves drawing, keys and controls to us. */
export function leafletMap(container: HTMLElement): L.Map {
  const map = L.map(container, {
    center: [25, 20],
    zoom: 2.5,
    minZoom: 2,
    maxZoom: 19,
    zoomSnap: 0.25,
    zoomDelta: 0.5,
    wheelPxPerZoomLevel: 120,
    // The canvases are drawn for one zoom at a time.
    zoomAnimation: false,
    zoomControl: false,
    preferCanvas: true,
    // Both are done here: a box selects, and keys are the page's shortcuts.
    boxZoom: false,
    keyboard: false,
  });
  map.attributionControl.setPrefix('<a href="https://leafletjs.com">Leaflet</a>');
  return map;
}
