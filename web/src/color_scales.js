// What the estimated path can be coloured by, and the legend of the colours.
import { el } from './dom.js';
import { length, percent, roundUp } from './format.js';
import { scaleColor } from './theme.js';
import { largest } from './series.js';

// The scale ends at the 98th percentile, rounded up: one short peak must not make all the rest look alike.
function scaleEnd(values) {
  const sorted = Float64Array.from(values).sort();
  return sorted.length === 0 ? 1 : roundUp(Math.max(1e-3, sorted[Math.floor(0.98 * (sorted.length - 1))]));
}

function lengthScale(name, path, values) {
  const max = scaleEnd(values);
  const end = largest(values) > max ? `≥ ${length(max)}` : length(max);
  return { name, path, values, max, ends: ['0', end], show: length };
}

/** {key: scale}; a scale is {name, path, values, max, ends, show}; 'plain' has none. */
export function colorScales({ errors, belief }) {
  const scales = {};
  if (errors) scales.error = lengthScale('position error', errors, errors.position_m);
  if (belief.t.length > 0) {
    const sigma = belief.var_x.map((v, i) => Math.sqrt(Math.max(0, v + belief.var_y[i])));
    scales.uncertainty = lengthScale('uncertainty (1σ)', belief, sigma);
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
