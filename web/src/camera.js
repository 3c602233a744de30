// Which part of the plane a canvas shows: y points up, `scale` is pixels per metre.

export class Camera {
  constructor() {
    this.x = 0;
    this.y = 0;
    this.scale = 20;
    this.width = 1;
    this.height = 1;
  }

  toScreen(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }

  toWorld(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }

  /** Shows a box {left, right, bottom, top} whole. */
  fit(box, margin = 24) {
    const spanX = Math.max(0.5, box.right - box.left);
    const spanY = Math.max(0.5, box.top - box.bottom);
    this.x = (box.left + box.right) / 2;
    this.y = (box.bottom + box.top) / 2;
    this.scale = Math.min(Math.max(1, this.width - 2 * margin) / spanX, Math.max(1, this.height - 2 * margin) / spanY);
  }

  /** Zooms so that the point under the pointer stays there. */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [x, y] = this.toWorld(px, py);
    this.scale = Math.min(4000, Math.max(0.2, this.scale * factor));
    const [nx, ny] = this.toWorld(px, py);
    this.x += x - nx;
    this.y += y - ny;
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /** Draws in metres of the plane from here on. */
  apply(context) {
    context.transform(this.scale, 0, 0, -this.scale,
      this.width / 2 - this.x * this.scale, this.height / 2 + this.y * this.scale);
  }

  sees(x, y, slack = 40) {
    const [px, py] = this.toScreen(x, y);
    return px > -slack && py > -slack && px < this.width + slack && py < this.height + slack;
  }
}
