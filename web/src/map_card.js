// The map panel: the whole map, a close-up that follows the robot, the layers, and the slider through time.
import { colorScales, paintLegend } from './color_scales.js';
import { card, el, tip } from './dom.js';
import { angle, figure, instant } from './format.js';
import { boxOf, MapImage } from './map_image.js';
import { letPointerMove, MapView } from './map_view.js';
import { ellipseOf } from './map_layers.js';
import { makeReadout } from './readout.js';
import { nearest, poseAt } from './series.js';
import { onThemeChange } from './theme.js';

const kLayers = [
  ['map', 'map'], ['reference', 'reference'], ['estimate', 'estimate'], ['particles', 'particles'], ['ellipse', '95 % ellipse'],
];

function makeScene(run) {
  const scales = colorScales(run);
  const scene = {
    run, scales, image: new MapImage(run.map), colorBy: Object.keys(scales)[0],
    layers: Object.fromEntries(kLayers.map(([key]) => [key, true])),
  };
  scene.scale = () => scales[scene.colorBy];
  return scene;
}

function contentBox({ run, image }) {
  const paths = [run.path, run.reference].filter((path) => path?.t.length > 0);
  const points = paths.flatMap((path) => path.x.map((x, i) => [x, path.y[i]]));
  if (image.box) points.push([image.box.left, image.box.bottom], [image.box.right, image.box.top]);
  return points.length > 0 ? boxOf(points) : { left: -5, right: 5, bottom: -5, top: 5 };
}

function available(run, key) {
  if (key === 'map') return Boolean(run.map);
  if (key === 'reference') return Boolean(run.reference);
  if (key === 'particles') return run.particles.t.length > 0;
  return key === 'estimate' || run.belief.t.length > 0;
}

function layerControls(scene, redraw) {
  return kLayers.filter(([key]) => available(scene.run, key)).map(([key, name]) => {
    const box = el('input', { type: 'checkbox', checked: true, 'data-layer': key });
    box.addEventListener('change', () => {
      scene.layers[key] = box.checked;
      redraw();
    });
    return el('label', {}, box, el('span', { class: `swatch ${key}` }), name);
  });
}

function colorControl(scene, redraw) {
  const legend = el('span', { class: 'legend' });
  const choice = el('select', { id: 'color-by', 'aria-label': 'colour of the path' },
    ...Object.keys(scene.scales).map((key) => el('option', { value: key }, key)));
  const paint = () => paintLegend(legend, scene.scale());
  choice.addEventListener('change', () => {
    scene.colorBy = choice.value;
    paint();
    redraw();
  });
  paint();
  onThemeChange.add(paint);
  return el('span', { class: 'color-by' }, el('label', {}, 'path coloured by ', choice), legend);
}

function player(timeline) {
  const play = el('button', { id: 'play', class: 'primary', type: 'button', onclick: () => timeline.toggle() });
  const slider = el('input', {
    id: 'time', type: 'range', min: timeline.start, max: timeline.end, step: Math.max(0.01, timeline.span / 5000),
    'aria-label': 'instant of the run, seconds',
    oninput: (event) => {
      timeline.playing = false;
      timeline.set(Number(event.target.value));
    },
  });
  const speeds = [0.2, 1, 5].map((factor) => factor * timeline.speed);
  const speed = el('select', { 'aria-label': 'speed of playing', onchange: (event) => { timeline.speed = Number(event.target.value); } },
    ...speeds.map((value) => el('option', { value, selected: value === timeline.speed }, `${figure(value, 2)}× real time`)));
  const clock = el('output', { id: 'clock' });
  timeline.onChange((now) => {
    play.textContent = timeline.playing ? '❚❚ Pause' : '▶ Play';
    slider.value = now;
    clock.textContent = instant(now);
  });
  return el('div', { class: 'player' }, play, slider, clock, speed);
}

// The nearest sample of the path within a finger's width of the pointer.
function sampleUnder(scene, camera, px, py) {
  const path = scene.scale()?.path ?? scene.run.path;
  let best = { i: -1, distance: 14 };
  for (let i = 0; i < path.t.length; ++i) {
    const [x, y] = camera.toScreen(path.x[i], path.y[i]);
    const distance = Math.hypot(x - px, y - py);
    if (distance < best.distance) best = { i, distance };
  }
  return best.i < 0 ? undefined : { path, i: best.i };
}

function hover(scene, view, timeline, frame) {
  const hint = el('div', { class: 'map-tip', hidden: true });
  const where = el('div', { class: 'where' });
  frame.append(hint, where);
  const onMove = (px, py) => {
    const [x, y] = view.camera.toWorld(px, py);
    where.textContent = `x ${x.toFixed(2)} m, y ${y.toFixed(2)} m`;
    const found = sampleUnder(scene, view.camera, px, py);
    hint.hidden = !found;
    if (!found) return;
    const scale = scene.scale();
    const rows = scale ? [[scale.name, scale.show(scale.values[found.i])]] : [];
    hint.replaceChildren(tip(instant(found.path.t[found.i]), rows));
    hint.style.left = `${Math.min(px + 14, view.camera.width - 200)}px`;
    hint.style.top = `${py + 14}px`;
  };
  const onClick = (px, py) => {
    const found = sampleUnder(scene, view.camera, px, py);
    if (found) timeline.set(found.path.t[found.i]);
  };
  view.canvas.addEventListener('pointerleave', () => { hint.hidden = true; });
  letPointerMove(view, { onMove, onClick });
}

function mainView(scene, timeline) {
  const view = new MapView(scene, timeline, 'map with the paths of the run', (self) => {
    if (!self.touched) self.camera.fit(contentBox(scene));
  });
  const touch = (action) => () => {
    view.touched = true;
    action();
    view.redraw();
  };
  const button = (text, label, action) => el('button', { type: 'button', title: label, 'aria-label': label, onclick: touch(action) }, text);
  const fit = () => {
    view.touched = false;
    view.camera.fit(contentBox(scene));
  };
  for (const kind of ['pointerdown', 'wheel']) view.canvas.addEventListener(kind, (e) => { view.touched ||= kind !== 'wheel' || e.ctrlKey; });
  const frame = el('div', { class: 'map-frame' }, view.canvas, el('div', { class: 'zoom' },
    button('+', 'zoom in', () => view.camera.zoom(1.5)), button('−', 'zoom out', () => view.camera.zoom(1 / 1.5)),
    el('button', { type: 'button', title: 'show all', 'aria-label': 'show all', onclick: () => { fit(); view.redraw(); } }, '⤢')));
  hover(scene, view, timeline, frame);
  return { view, frame, fit };
}

// Follows the robot at a scale that shows its uncertainty and its error.
function closeUp(scene, timeline) {
  const view = new MapView(scene, timeline, 'close-up around the robot');
  view.canvas.classList.add('close-up');
  view.beforeDraw = () => {
    const { path, belief, errors } = scene.run;
    const pose = poseAt(path, timeline.now);
    if (!pose) return;
    const b = nearest(belief.t, timeline.now);
    const sigma = b < 0 ? 0 : ellipseOf(belief.var_x[b], belief.cov_xy[b], belief.var_y[b]).major;
    const error = errors ? errors.position_m[nearest(errors.t, timeline.now)] ?? 0 : 0;
    const span = [0.6, 1.5, 3, 6, 12, 25].find((size) => size >= Math.max(14 * sigma, 3 * error)) ?? 50;
    Object.assign(view.camera, { x: pose.x, y: pose.y, scale: view.camera.width / span });
  };
  return view;
}

export function drawMapCard(run, timeline, parent) {
  const scene = makeScene(run);
  const main = mainView(scene, timeline);
  const near = closeUp(scene, timeline);
  const redraw = () => {
    main.view.redraw();
    near.redraw();
  };
  const side = el('div', { class: 'side' }, near.canvas, makeReadout(run, timeline));
  const controls = el('div', { class: 'controls' }, ...layerControls(scene, redraw), colorControl(scene, redraw));
  parent.append(
    card('Map').element.firstChild, controls, el('div', { class: 'map-row' }, main.frame, side), player(timeline),
    el('p', { class: 'hint' }, 'Drag to move the map, Ctrl + wheel to zoom, click on the path or in a chart to go to that instant. ',
      'Charts over time zoom together: Ctrl + wheel, double click to see all.'));
  if (!run.map) main.frame.append(el('p', { class: 'map-missing' }, 'The run directory holds no map.'));
  scene.image.load().then(() => {
    main.fit();
    redraw();
    document.documentElement.dataset.map = 'drawn';
  });
}
