// What holds at the instant of the timeline, in words and figures.
import { el } from './dom.js';
import { angle, count, figure, instant, length, percent } from './format.js';
import { nearest, poseAt } from './series.js';
import { ellipseOf } from './map_layers.js';

function poseRows(run, now) {
  const pose = poseAt(run.path, now);
  if (!pose) return [];
  const e = run.errors ? nearest(run.errors.t, now) : -1;
  const error = e < 0 ? [] : [
    ['position error', length(run.errors.position_m[e])], ['heading error', angle(run.errors.heading_rad[e])]];
  return [['x', `${pose.x.toFixed(2)} m`], ['y', `${pose.y.toFixed(2)} m`], ['heading', angle(pose.theta)], ...error];
}

function beliefRows({ belief: b }, now) {
  const i = nearest(b.t, now);
  if (i < 0) return [];
  const { major, minor } = ellipseOf(b.var_x[i], b.cov_xy[i], b.var_y[i]);
  return [
    ['σ along / across', `${length(major)} / ${length(minor)}`], ['σ heading', angle(Math.sqrt(Math.max(0, b.var_theta[i])))],
    ['particles', count(b.particles[i])], ['effective sample size', figure(b.ess[i])],
    ['hypotheses', count(b.hypotheses[i])], ['weight of the heaviest', percent(b.weight[i])], ['quality', percent(b.quality[i])],
  ];
}

export function makeReadout(run, timeline) {
  const list = el('dl', { class: 'readout', id: 'readout' });
  timeline.onChange((now) => {
    const rows = [['time', instant(now)], ...poseRows(run, now), ...beliefRows(run, now)];
    list.replaceChildren(...rows.flatMap(([name, value]) => [el('dt', {}, name), el('dd', {}, value)]));
  });
  return list;
}
