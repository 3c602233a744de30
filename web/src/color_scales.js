// What the estimated path can be coloured by, and the legend of the colours.
import { el } from './dom.js';
import { length, percent, roundUp } from './format.js';
import { scaleColor } from './theme.js';
import { largest } from './series.js';

const percentile95 = (values) => Float64Array.from(values).sort()[Math.floor(0.95 * (values.length - 1))];

// The scale ends at the 95th percentile, rounded up: one short peak must not make all the rest look alike.
function lengthScale(name, path, values, p95) {
  const max = roundUp(Math.max(1e-3, p95));
  const end = largest(values) > max ? `≥ ${length(max)}` : length(max);
  return { name, path, values, max, ends: ['0', end], show: length };
}

/** {key: scale}; a scale is {name, path, values, max, ends, show}; 'plain' has none. */
export function colorScales({ errors, belief }) {
  const scales = {};
  if (errors) scales.error = lengthScale('position error', errors, errors.position_m, errors.p95_m);
  if (belief.t.length > 0) {
    const sigma = belief.var_x.map((v, i) => Math.sqrt(Math.max(0, v + belief.var_y[i])));
    scales.uncertainty = lengthScale('uncertainty (1σ)', belief, sigma, percentile95(sigma));
    const badness = belief.quality.map((q) => 1 - q);
    scales.quality = { name: 'quality', path: belief, values: badness, max: 1, ends: ['100 %', '0 %'], show: (v) => percent(1 - v) };
  }
  scales.plain = undefined;
  return scales;
}

export function paintLegend(box, scale) {
  box.replaceChildren();
  if (!scale) return;
  const stops = Array.from({ length: 9 }, (_, i) => scaleColor(i / 8)).join(',');
  box.append(el('span', {}, scale.name), el('span', { class: 'end' }, scale.ends[0]),
    el('span', { class: 'ramp', style: `background:linear-gradient(90deg,${stops})` }), el('span', { class: 'end' }, scale.ends[1]));
}
