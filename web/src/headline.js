// Title, verdict and the tiles with the figures that matter most.
import { byId, el } from './dom.js';
import { angle, bytes, count, figure, length, percent, seconds } from './format.js';
import { largest, smallest } from './series.js';

const fileName = (path) => String(path ?? '').split('/').pop() || 'unnamed log';

export function drawHeader({ metrics }) {
  const title = fileName(metrics.log?.path);
  document.title = `${title} – Cairn report`;
  const facts = [
    ['recipe', metrics.recipe], ['map', metrics.map && fileName(metrics.map.path)], ['seed', metrics.seed],
    ['threads', metrics.threads],
  ].filter(([, value]) => value !== undefined && value !== null);
  byId('headline').append(
    el('div', { class: 'brand' }, 'Cairn localization report'), el('h1', {}, title),
    el('p', { class: 'facts' }, ...facts.map(([name, value]) => el('span', {}, `${name} `, el('b', {}, String(value))))));
  drawVerdict(metrics);
}

function drawVerdict(metrics) {
  const lost = metrics.verdict === 'lost';
  const badge = (kind, text) => el('span', { class: `badge ${kind}` }, text);
  const badges = [];
  if (metrics.verdict) badges.push(badge(lost ? 'bad' : 'good', lost ? '✕ lost' : '✓ tracking'));
  if (metrics.interrupted) badges.push(badge('warn', '! interrupted'));
  byId('verdict').append(...badges);
  if (metrics.verdict_reason) byId('verdict').append(el('p', {}, metrics.verdict_reason));
}

// A stream that the configuration does not use is no loss: the table of outcomes shows it, this figure leaves it out.
function droppedShare(outcomes) {
  const streams = Object.values(outcomes ?? {});
  const sum = (pick) => streams.reduce((total, stream) =>
    total + Object.entries(stream).reduce((n, [name, value]) => n + (pick(name) ? value : 0), 0), 0);
  const all = sum((name) => name !== 'dropped_unbound_stream');
  return { all, dropped: sum((name) => name.startsWith('dropped') && name !== 'dropped_unbound_stream') };
}

function particleRange(run) {
  const values = run.series.particles.v;
  if (values.length === 0) return undefined;
  const [low, high] = [smallest(values), largest(values)];
  return low === high ? count(high) : `${count(low)}–${count(high)}`;
}

export function drawTiles(run, parent) {
  const { accuracy, timings, log, updates, outcomes, peak_memory_bytes: memory } = run.metrics;
  const messages = droppedShare(outcomes);
  const tile = (name, value, note) => value !== undefined && value !== '–' && parent.append(
    el('div', { class: 'tile' }, el('div', { class: 'name' }, name), el('div', { class: 'value' }, value),
      el('div', { class: 'note' }, note ?? '')));
  if (accuracy) {
    tile('Mean position error', length(accuracy.ate_mean_m), `RMSE ${length(accuracy.ate_rmse_m)}`);
    tile('Max position error', length(accuracy.ate_max_m), `95 % below ${length(accuracy.ate_p95_m)}`);
    tile('Mean heading error', angle(accuracy.heading_mean_rad), `max ${angle(accuracy.heading_max_rad)}`);
  }
  tile('Filter updates', count(updates), log?.span_s === undefined ? '' : `in ${seconds(log.span_s)} of log`);
  tile('Particles', particleRange(run), 'least to most');
  tile('Real-time factor', timings?.realtime_factor === undefined ? undefined : `${figure(timings.realtime_factor)}×`,
    timings?.update_mean_ms === undefined ? '' : `${figure(timings.update_mean_ms)} ms an update`);
  if (messages.all > 0) {
    tile('Messages dropped', percent(messages.dropped / messages.all), `of ${count(messages.all)} in use`);
  }
  tile('Peak memory', bytes(memory), '');
}
