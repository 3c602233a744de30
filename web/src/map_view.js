// A canvas that shows the map and the run's layers through a camera.
import { Camera } from './camera.js';
import { el } from './dom.js';
import { color, onThemeChange } from './theme.js';
import { drawCloud, drawEllipse, drawEstimate, drawOtherPlaces, drawReference, drawRobot, drawScaleBar } from './map_layers.js';
import { poseAt } from './series.js';

// Pixels per metre from which on the robot is shown from near.
const kNear = 80;

export class MapView {
  /** @param scene {run, image, layers, scale} shared by all views, see map_card.js */
  constructor(scene, timeline, label, onResize) {
    this.scene = scene;
    this.timeline = timeline;
    this.camera = new Camera();
    this.canvas = el('canvas', { role: 'img', 'aria-label': label });
    this.pending = false;
    new ResizeObserver(() => this.resize(onResize)).observe(this.canvas);
    timeline.onChange(() => this.redraw());
    onThemeChange.add(() => this.resize(onResize));
  }

  resize(onResize) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    const ratio = devicePixelRatio || 1;
    [this.canvas.width, this.canvas.height] = [width * ratio, height * ratio];
    [this.camera.width, this.camera.height] = [width, height];
    onResize?.(this);
    this.draw();
  }

  /** Draws once before the next frame, however often it is called. */
  redraw() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.draw();
    });
  }

  draw() {
    this.beforeDraw?.();
    const { run, image, layers, scale } = this.scene;
    const { camera, timeline: { now } } = this;
    const context = this.canvas.getContext('2d');
    const ratio = devicePixelRatio || 1;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = color('map-unknown');
    context.fillRect(0, 0, camera.width, camera.height);
    if (layers.map) image.draw(context, camera);
    if (layers.reference) drawReference(context, camera, run);
    if (layers.estimate) drawEstimate(context, camera, run, now, scale());
    // From near the belief is what matters, from afar it would hide the robot.
    const order = [() => this.drawRobots(context), () => this.drawBelief(context)];
    if (camera.scale < kNear) order.reverse();
    for (const layer of order) layer();
    drawScaleBar(context, camera);
  }

  drawRobots(context) {
    const { scene: { run, layers }, camera, timeline: { now } } = this;
    if (layers.reference && run.reference) drawRobot(context, camera, poseAt(run.reference, now), color('reference'));
    if (layers.estimate) drawRobot(context, camera, poseAt(run.path, now), color('estimate'));
  }

  drawBelief(context) {
    const { scene: { run, layers }, camera, timeline: { now } } = this;
    if (layers.particles) drawCloud(context, camera, run, now);
    if (layers.ellipse) drawOtherPlaces(context, camera, run, now);
    if (layers.ellipse) drawEllipse(context, camera, run, now);
  }
}

/** Dragging moves, Ctrl + wheel (or a pinch on a touch-pad) zooms. */
export function letPointerMove(view, { onMove, onClick }) {
  const { canvas, camera } = view;
  let moved = 0;
  let dragging = false;
  const place = (event) => [event.offsetX, event.offsetY];
  canvas.addEventListener('pointerdown', (event) => {
    [dragging, moved] = [true, 0];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!dragging) return onMove(...place(event));
    moved += Math.abs(event.movementX) + Math.abs(event.movementY);
    camera.pan(event.movementX, event.movementY);
    return view.redraw();
  });
  canvas.addEventListener('pointerup', (event) => {
    dragging = false;
    if (moved < 4) onClick(...place(event));
  });
  canvas.addEventListener('pointercancel', () => { dragging = false; });
  canvas.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    camera.zoom(Math.exp(-event.deltaY * 0.002), ...place(event));
    view.redraw();
  }, { passive: false });
}
