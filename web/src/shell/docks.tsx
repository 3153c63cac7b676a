/** The three places for panels around the map: drawer on the left, column on the right, dock below. */
import { Icon } from "./icon";
import {
  dock_height_px,
  dock_open,
  dock_panel,
  drawer_panel,
  drawer_width_px,
  side_open,
  side_panel,
  side_width_px,
  toggleDrawer,
} from "./layout";
import { kDockPanels, kDrawerPanels, kSidePanels, type PanelSpec } from "./panel_list";
import type { PanelProps } from "./panel_props";
import { useShortcuts } from "./shortcuts";
import { Splitter } from "./splitter";
import { Tabs } from "./tabs";

/** The one that was open last time, when it still exists. */
function shownOf<Spec extends PanelSpec>(panels: readonly Spec[], id: string): Spec | undefined {
  return panels.find((panel) => panel.id === id) ?? panels[0];
}

/** Opens the tools. */
export function Rail() {
  useShortcuts(
    kDrawerPanels.map(({ id, title, shortcut }) => ({
      keys: shortcut,
      label: `${title}: open or close`,
      group: "Panels",
      run: () => {
        toggleDrawer(id);
      },
    })),
  );
  return (
    <nav class="rail" aria-label="Tools">
      {kDrawerPanels.map(({ id, title, icon, shortcut }) => (
        <button
          key={id}
          type="button"
          class="rail-button"
          aria-pressed={drawer_panel.value === id}
          title={`${title} (${shortcut.toUpperCase()})`}
          onClick={() => {
            toggleDrawer(id);
          }}
        >
          <Icon name={icon} />
          <span>{title}</span>
        </button>
      ))}
    </nav>
  );
}

export function Drawer({ station }: PanelProps) {
  const panel = kDrawerPanels.find(({ id }) => id === drawer_panel.value);
  if (panel === undefined) return null;
  return (
    <aside class="drawer" aria-labelledby="drawer-title" style={{ width: `${drawer_width_px.value}px` }}>
      <header class="drawer-head">
        <h2 id="drawer-title">{panel.title}</h2>
        <button
          type="button"
          class="bar-button"
          aria-label={`Close ${panel.title}`}
          title={`Close ${panel.title}`}
          onClick={() => {
            toggleDrawer(panel.id);
          }}
        >
          <Icon name="close" />
        </button>
      </header>
      <div class="drawer-body">
        <panel.view station={station} key={panel.id} />
      </div>
      <Splitter
        label={`Width of ${panel.title}`}
        size_px={drawer_width_px}
        least_px={300}
        most_px={900}
        edge="right"
      />
    </aside>
  );
}

export function SideColumn({ station }: PanelProps) {
  const panel = shownOf(kSidePanels, side_panel.value);
  if (panel === undefined) return null;
  const open = side_open.value;
  return (
    <aside
      class={open ? "side" : "side closed"}
      aria-label="Alarms and events"
      style={open ? { width: `${side_width_px.value}px` } : {}}
    >
      <header class="dock-head">
        {open && (
          <Tabs
            label="Alarms and events"
            tabs={kSidePanels}
            shown={panel.id}
            show={(id) => {
              side_panel.value = id;
            }}
            controls="side-body"
          />
        )}
        <button
          type="button"
          class="bar-button"
          aria-expanded={open}
          aria-label={open ? "Hide the column" : "Show alarms and events"}
          title={open ? "Hide the column" : "Show alarms and events"}
          onClick={() => {
            side_open.value = !open;
          }}
        >
          <Icon name={open ? "aside" : "alarm"} />
        </button>
      </header>
      {open && (
        <>
          <div class="side-body" id="side-body" role="tabpanel" aria-label={panel.title}>
            <panel.view station={station} key={panel.id} />
          </div>
          <Splitter
            label="Width of the column"
            size_px={side_width_px}
            least_px={240}
            most_px={700}
            edge="left"
          />
        </>
      )}
    </aside>
  );
}

export function Dock({ station }: PanelProps) {
  useShortcuts(
    kDockPanels.map(({ id, title, shortcut, keys }) => ({
      keys: shortcut,
      label: `${title}: go there. In it, ${keys}`,
      group: "Panels",
      run: () => {
        dock_panel.value = id;
        dock_open.value = true;
        // Once the page has it, and before the next key.
        queueMicrotask(() => {
          document.querySelector<HTMLElement>("#dock-body [data-keys]")?.focus();
        });
      },
    })),
  );
  const panel = shownOf(kDockPanels, dock_panel.value);
  if (panel === undefined) return null;
  const open = dock_open.value;
  return (
    <section
      class={open ? "dock" : "dock closed"}
      aria-label="Fleet data"
      style={open ? { height: `${dock_height_px.value}px` } : {}}
    >
      <header class="dock-head">
        <Tabs
          label="Fleet data"
          tabs={kDockPanels}
          shown={panel.id}
          show={(id) => {
            dock_panel.value = id;
            dock_open.value = true;
          }}
          controls="dock-body"
        />
        <button
          type="button"
          class="bar-button"
          aria-expanded={open}
          aria-label={open ? "Hide the dock" : "Show the dock"}
          title={open ? "Hide the dock" : "Show the dock"}
          onClick={() => {
            dock_open.value = !open;
          }}
        >
          <Icon name={open ? "collapse" : "expand"} />
        </button>
      </header>
      <div class="dock-body" id="dock-body" role="tabpanel" aria-label={panel.title} hidden={!open}>
        {open && <panel.view station={station} key={panel.id} />}
      </div>
      {open && (
        <Splitter
          label="Height of the dock"
          size_px={dock_height_px}
          least_px={120}
          most_px={1400}
          edge="top"
        />
      )}
    </section>
  );
}
