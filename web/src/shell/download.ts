/** Gives the person a file. */
export function download(name: string, content: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  // The browser has taken hold of it by the next turn.
  setTimeout(() => {
    URL.revokeObjectURL(link.href);
  });
}

/** "skein-20260101T120000Z.csv" */
export function fileName(utime: number, extension: string): string {
  const stamp = new Date(utime / 1000).toISOString().replace(/[-:]|\.\d+/g, "");
  return `skein-${stamp}.${extension}`;
}
