// What is drawn over the map: each function draws one layer of one instant.
import { color, scaleColor } from './theme.js';
import { nearest, poseAt } from './series.js';

// 95 % of a Gaussian in the plane lie within this many sigmas: sqrt of the chi-square quantile, 2 degrees of freedom.
const kEllipse95 = 2.4477;
const kShades = 24;

function strokePath(context, camera, path, from, to, style) {
  context.save();
  context.lineJoin = 'round';
  Object.assign(context, { strokeStyle: style.color, lineWidth: style.width, globalAlpha: style.alpha ?? 1 });
  context.setLineDash(style.dash ?? []);
  context.beginPath();
  let drawing = false;
  for (let i = from; i <= to; ++i) {
    const visible = camera.sees(path.x[i], path.y[i], 4000);
    if (visible) context[drawing ? 'lineTo' : 'moveTo'](...camera.toScreen(path.x[i], path.y[i]));
    drawing = visible;
  }
  context.stroke();
  context.restore();
}

export function drawReference(context, camera, run) {
  if (!run.reference) return;
  strokePath(context, camera, run.reference, 0, run.reference.t.length - 1,
    { color: color('reference'), width: 5, alpha: 0.45 });
}

/** The estimated path: strong up to now, faint after. `scale` {columns, values, max} colours it; else it is plain. */
export function drawEstimate(context, camera, run, now, scale) {
  if (scale) {
    strokeShaded(context, camera, scale, now);
    return;
  }
  const { path } = run;
  const here = nearest(path.t, now);
  const style = { color: color('estimate'), width: 2 };
  if (here < 0) return;
  strokePath(context, camera, path, here, path.t.length - 1, { ...style, alpha: 0.25 });
  strokePath(context, camera, path, 0, here, style);
}

// Segments of one shade are drawn in one stroke: thousands of single strokes would not play smoothly.
function strokeShaded(context, camera, { path, values, max }, now) {
  const shades = Array.from({ length: 2 * kShades }, () => []);
  for (let i = 1; i < path.t.length; ++i) {
    if (!camera.sees(path.x[i], path.y[i], 400)) continue;
    const shade = Math.min(kShades - 1, Math.floor(values[i] / max * kShades));
    shades[path.t[i] <= now ? kShades + shade : shade].push(i);
  }
  context.save();
  context.lineCap = 'round';
  context.lineWidth = 2.4;
  shades.forEach((segments, k) => {
    context.globalAlpha = k < kShades ? 0.22 : 1;
    context.strokeStyle = scaleColor((k % kShades + 0.5) / kShades);
    context.beginPath();
    for (const i of segments) {
      context.moveTo(...camera.toScreen(path.x[i - 1], path.y[i - 1]));
      context.lineTo(...camera.toScreen(path.x[i], path.y[i]));
    }
    if (segments.length > 0) context.stroke();
  });
  context.restore();
}

export function cloudAt(run, now) {
  const i = nearest(run.particles.t, now);
  return i < 0 ? undefined : { t: run.particles.t[i], poses: run.particles.mm[i] };
}

/** Particles as dots, with a tick for the heading where there is room. */
export function drawCloud(context, camera, run, now) {
  const cloud = cloudAt(run, now);
  if (!cloud) return;
  const ticks = camera.scale > 60;
  context.save();
  context.fillStyle = context.strokeStyle = color('particles');
  context.globalAlpha = 0.55;
  context.beginPath();
  for (let i = 0; i < cloud.poses.length; i += 3) {
    const [x, y] = [cloud.poses[i] / 1000, cloud.poses[i + 1] / 1000];
    if (!camera.sees(x, y)) continue;
    const [px, py] = camera.toScreen(x, y);
    const heading = cloud.poses[i + 2] / 1000;
    context.rect(px - 1.3, py - 1.3, 2.6, 2.6);
    if (ticks) tick(context, px, py, heading);
  }
  context.fill();
  if (ticks) context.stroke();
  context.restore();
}

function tick(context, px, py, heading) {
  context.moveTo(px, py);
  context.lineTo(px + 9 * Math.cos(heading), py - 9 * Math.sin(heading));
}

/** Semi-axes (sigmas, metres) and direction of the position's covariance. */
export function ellipseOf(varX, covXY, varY) {
  const mean = (varX + varY) / 2;
  const spread = Math.hypot((varX - varY) / 2, covXY);
  return {
    major: Math.sqrt(Math.max(0, mean + spread)),
    minor: Math.sqrt(Math.max(0, mean - spread)),
    angle: 0.5 * Math.atan2(2 * covXY, varX - varY),
  };
}

export function drawEllipse(context, camera, run, now) {
  const { belief } = run;
  const i = nearest(belief.t, now);
  const pose = poseAt(run.path, now);
  if (i < 0 || !pose) return;
  const { major, minor, angle } = ellipseOf(belief.var_x[i], belief.cov_xy[i], belief.var_y[i]);
  const [px, py] = camera.toScreen(pose.x, pose.y);
  const size = kEllipse95 * camera.scale;
  context.save();
  context.beginPath();
  context.ellipse(px, py, Math.max(0.5, major * size), Math.max(0.5, minor * size), -angle, 0, 2 * Math.PI);
  context.fillStyle = context.strokeStyle = color('accent');
  context.globalAlpha = 0.15;
  context.fill();
  context.globalAlpha = 1;
  context.lineWidth = 1.5;
  context.stroke();
  context.restore();
}

// x, y, var_x, cov_xy, var_y, weight, age_s of each place in turn.
const kPlaceFigures = 7;

/** The other places where the robot may be: ellipses, the stronger the heavier, each with its weight and age. */
export function drawOtherPlaces(context, camera, run, now) {
  const { t, places } = run.hypotheses;
  const i = nearest(t, now);
  if (i < 0) return;
  context.save();
  context.font = '11px system-ui, sans-serif';
  context.textAlign = 'center';
  context.fillStyle = context.strokeStyle = color('accent');
  for (let k = kPlaceFigures; k < places[i].length; k += kPlaceFigures) {
    const [x, y, varX, covXY, varY, weight, age] = places[i].slice(k, k + kPlaceFigures);
    if (!camera.sees(x, y)) continue;
    const { major, minor, angle } = ellipseOf(varX, covXY, varY);
    const [px, py] = camera.toScreen(x, y);
    const size = kEllipse95 * camera.scale;
    context.globalAlpha = 0.4 + 0.6 * weight;
    context.beginPath();
    context.ellipse(px, py, Math.max(4, major * size), Math.max(4, minor * size), -angle, 0, 2 * Math.PI);
    context.stroke();
    context.fillText(`${Math.round(100 * weight)} %, ${age.toFixed(1)} s`, px, py - 8);
  }
  context.restore();
}

/** An arrow-head at a pose. */
export function drawRobot(context, camera, pose, fill) {
  if (!pose) return;
  context.save();
  context.translate(...camera.toScreen(pose.x, pose.y));
  context.rotate(-pose.theta);
  context.beginPath();
  context.moveTo(11, 0);
  context.lineTo(-7, 6.5);
  context.lineTo(-3.5, 0);
  context.lineTo(-7, -6.5);
  context.closePath();
  Object.assign(context, { fillStyle: fill, strokeStyle: color('card'), lineWidth: 1.5, lineJoin: 'round' });
  context.fill();
  context.stroke();
  context.restore();
}

/** A bar of a round length, at the lower left. */
export function drawScaleBar(context, camera) {
  const lengths = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500];
  const metres = lengths.find((length) => length * camera.scale >= 60) ?? 1000;
  const pixels = metres * camera.scale;
  const [x, y] = [16, camera.height - 16];
  context.save();
  context.fillStyle = color('card');
  context.globalAlpha = 0.85;
  context.fillRect(x - 8, y - 24, pixels + 16, 34);
  context.globalAlpha = 1;
  Object.assign(context, { strokeStyle: color('text'), fillStyle: color('text'), lineWidth: 2, font: '12px system-ui, sans-serif', textAlign: 'center' });
  context.beginPath();
  context.moveTo(x, y - 5);
  context.lineTo(x, y);
  context.lineTo(x + pixels, y);
  context.lineTo(x + pixels, y - 5);
  context.stroke();
  context.fillText(metres < 1 ? `${Math.round(metres * 100)} cm` : `${metres} m`, x + pixels / 2, y - 8);
  context.restore();
}
