/** Texts of the station in the units that the person has chosen. The bus says everything in metres and metres per second. */
import { altitude, distance, farDistance, speed } from "./quantities";

/** A number and its unit, each a word of its own: neither "UAV3", nor "m" alone, nor "m/s²". */
const kQuantity = /(?<![\w.,-])(-?\d+(?:\.\d+)?) (m\/s|km|m)(?![\w/²])/g;
/** What goes before or after a height, in the words of the nodes. */
const kHeightBefore =
  /\b(?:climb\w*|descend\w*|altitude\w*|height|H|up) (?:(?:of|is|by|to|from|at|than) )?$/i;
const kHeightAfter = /^ (?:in height|above|below|higher|lower|up|down|ENU|to go)\b/;

/**
 * "climbing 200 m: link of UAV3 lost" becomes "climbing 656 ft: link of UAV3 lost". Only quantities change: a number that is followed by
 * its unit. In metres a text is left as it is.
 */
export function inChosenUnits(text: string): string {
  return text.replace(kQuantity, (whole, number: string, unit: string, at: number) => {
    const decimals = number.split(".")[1]?.length ?? 0;
    const value = Number(number);
    if (unit === "m/s") return speed.unit() === "m/s" ? whole : speed.full(value, decimals);
    if (unit === "km") return distance.unit() === "m" ? whole : farDistance(value * 1000);
    const height = kHeightBefore.test(text.slice(0, at)) || kHeightAfter.test(text.slice(at + whole.length));
    const quantity = height ? altitude : distance;
    return quantity.unit() === "m" ? whole : quantity.full(value, decimals);
  });
}
