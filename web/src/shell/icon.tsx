/** Line drawings of 16 by 16, in the colour of the text. */
const kIcons = {
  formation: "M8 2l2 4H6zM3 9l2 4H1zM13 9l2 4h-4z",
  plan: "M3 13a1.500 1.500 0 1 0 0-.01M13 3a1.500 1.500 0 1 0 0-.01M4.500 13H10a2.500 2.500 0 0 0 0-5H6a2.500 2.500 0 0 1 0-5h5.500",
  simulation: "M2 8a6 6 0 1 1 2 4.500M2 13v-3h3M6.500 5.500v5l4-2.500z",
  payload: "M2 5.500h3l1-2h4l1 2h3v7H2zM8 6.800a2.200 2.200 0 1 0 .01 0",
  settings:
    "M2 4.500h6M12 4.500h2M2 11.500h2M8 11.500h6M10 2.800a1.700 1.700 0 1 0 .01 0M6 9.800a1.700 1.700 0 1 0 .01 0",
  help: "M5.500 6a2.500 2.500 0 1 1 3.500 2.300c-.7.3-1 .8-1 1.700M8 12.800v.2",
  close: "M3.500 3.500l9 9M12.500 3.500l-9 9",
  expand: "M3.500 10L8 5.500l4.500 4.500",
  collapse: "M3.500 6L8 10.500l4.500-4.500",
  aside: "M6 3.500L10.500 8L6 12.500",
  alarm: "M3 12h10c-1.200-1-1.500-2-1.500-5a3.500 3.500 0 0 0-7 0c0 3-.3 4-1.500 5zM6.800 14h2.400",
  sound: "M2 6h2.500l3.500-3v10l-3.500-3H2zM10.500 5.500a3.500 3.500 0 0 1 0 5M12.500 3.500a6 6 0 0 1 0 9",
  muted: "M2 6h2.500l3.500-3v10l-3.500-3H2zM10.500 6l4 4M14.500 6l-4 4",
  hold: "M5.500 3.500v9M10.500 3.500v9",
  play: "M5 3l8 5-8 5z",
  backwards: "M11 3L3 8l8 5z",
  step: "M4 3.500v9M7.500 4l5.500 4-5.500 4z",
  step_back: "M12 3.500v9M8.500 4L3 8l5.500 4z",
  next: "M3 4l5 4-5 4zM8 4l5 4-5 4M13.500 3.500v9",
  previous: "M13 4L8 8l5 4zM8 4L3 8l5 4M2.500 3.500v9",
  recordings: "M2 3.500h12v9H2zM2 10h12M6 3.500v9M10 3.500v9",
} as const;

export type IconName = keyof typeof kIcons;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 16 16" aria-hidden="true">
      <path d={kIcons[name]} />
    </svg>
  );
}
