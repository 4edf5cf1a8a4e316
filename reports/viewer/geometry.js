// Where the pixels of an inspection lie in its picture.

const kMargin = { left: 30, top: 6, right: 6, bottom: 22 };
const kLargestPixel = 72;
const kSmallPicture = 360; // height up to which few pixels are drawn larger, CSS pixels

/** How much of a pixel's side one of its samples is drawn with. */
const kSides = { 1: 1, 2: 0.5, 4: 0.42, 8: 0.27, 16: 0.19 };

/**
 * @param {import('./inspection.js').Inspection} inspection
 * @param {number} room  width that there is, CSS pixels
 */
export function geometryOf(inspection, room) {
  const { left, top, width, height, pattern, isUp } = inspection;
  const across = room - kMargin.left - kMargin.right;
  const pixel = Math.max(4, Math.min(across / width, Math.max(kLargestPixel, kSmallPicture / height)));
  const x = (u) => kMargin.left + (u - left) * pixel;
  const y = (v) => kMargin.top + (isUp ? top + height - v : v - top) * pixel;
  return {
    pixel,
    side: pixel * (kSides[pattern.length] ?? 0.19),
    width: kMargin.left + width * pixel + kMargin.right,
    height: kMargin.top + height * pixel + kMargin.bottom,
    plot: { x: kMargin.left, y: kMargin.top, width: width * pixel, height: height * pixel },
    x,
    y,
    /** The upper left corner of a pixel. */
    corner: (i, j) => [x(i), isUp ? y(j + 1) : y(j)],
    /** Where a sample is. */
    place: (sample) => {
      const [u, v] = pattern[sample.sample];
      return [x(sample.x + u), y(sample.y + v)];
    },
    /** The window position of a point of the picture. */
    window: (px, py) => {
      const across = left + (px - kMargin.left) / pixel;
      const down = (py - kMargin.top) / pixel;
      return [across, isUp ? top + height - down : top + down];
    },
  };
}

/** Every how many pixels an axis is labelled. */
export function labelStep(pixel) {
  return [1, 2, 4, 8, 16].find((step) => step * pixel >= 26) ?? 32;
}
