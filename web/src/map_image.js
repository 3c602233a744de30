// The occupancy grid as an image in the colours of the page, at its place in the plane.
import { color, onThemeChange, rgb } from './theme.js';

// map_server's grey of an unknown cell; free is 254, occupied 0.
const kUnknownGrey = 205;

export class MapImage {
  /** @param map {png (base64), width, height, resolution_m, origin: [x, y, yaw]} or undefined */
  constructor(map) {
    this.map = map;
    this.canvas = undefined;
    this.box = undefined;
    // Listens before the views do, so that they draw the new colours.
    onThemeChange.add(() => this.paint());
  }

  async load() {
    if (!this.map) return;
    const image = new Image();
    image.src = `data:image/png;base64,${this.map.png}`;
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    this.pixels = context.getImageData(0, 0, canvas.width, canvas.height);
    this.greys = Uint8Array.from({ length: canvas.width * canvas.height }, (_, i) => this.pixels.data[4 * i]);
    this.canvas = canvas;
    this.box = this.knownBox();
    this.paint();
  }

  paint() {
    if (!this.canvas) return;
    const { data } = this.pixels;
    const [free, wall, unknown] = ['map-free', 'map-wall', 'map-unknown'].map((name) => rgb(color(name)));
    for (let i = 0; i < this.greys.length; ++i) {
      const occupied = (254 - Math.min(254, this.greys[i])) / 254;
      for (let k = 0; k < 3; ++k) {
        data[4 * i + k] = this.greys[i] === kUnknownGrey ? unknown[k] : free[k] + occupied * (wall[k] - free[k]);
      }
      data[4 * i + 3] = 255;
    }
    this.canvas.getContext('2d').putImageData(this.pixels, 0, 0);
  }

  /** Box in the plane around nearly all cells that are known: a few rays that left through a window do not count. */
  knownBox() {
    const { width, height } = this.canvas;
    const [columns, rows] = [new Float64Array(width), new Float64Array(height)];
    for (let i = 0; i < this.greys.length; ++i) {
      if (this.greys[i] === kUnknownGrey) continue;
      columns[i % width] += 1;
      rows[Math.floor(i / width)] += 1;
    }
    const [[left, right], [top, bottom]] = [middleOf(columns), middleOf(rows)];
    const corners = [[left, top], [right + 1, top], [left, bottom + 1], [right + 1, bottom + 1]];
    return boxOf(corners.map(([column, row]) => this.toPlane(column, row)));
  }

  toPlane(column, row) {
    const { resolution_m: r, height, origin: [ox, oy, yaw] } = this.map;
    const [x, y] = [column * r, (height - row) * r];
    return [ox + Math.cos(yaw) * x - Math.sin(yaw) * y, oy + Math.sin(yaw) * x + Math.cos(yaw) * y];
  }

  draw(context, camera) {
    if (!this.canvas) return;
    const { resolution_m: r, height, origin: [ox, oy, yaw] } = this.map;
    context.save();
    camera.apply(context);
    context.translate(ox, oy);
    context.rotate(yaw);
    context.scale(r, -r);
    context.translate(0, -height);
    context.imageSmoothingEnabled = camera.scale * r < 2;
    context.imageSmoothingQuality = 'high';
    context.drawImage(this.canvas, 0, 0);
    context.restore();
  }
}

// First and last index between which all but a hundredth of the counts lie at either end.
function middleOf(counts) {
  const total = counts.reduce((a, b) => a + b, 0);
  if (total === 0) return [0, counts.length - 1];
  let sum = 0;
  const ends = [];
  counts.forEach((n, i) => {
    if (sum <= 0.01 * total && sum + n > 0.01 * total) ends[0] = i;
    if (sum < 0.99 * total && sum + n >= 0.99 * total) ends[1] = i;
    sum += n;
  });
  return ends;
}

export function boxOf(points) {
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (const [x, y] of points) {
    box.left = Math.min(box.left, x);
    box.right = Math.max(box.right, x);
    box.bottom = Math.min(box.bottom, y);
    box.top = Math.max(box.top, y);
  }
  return box;
}
