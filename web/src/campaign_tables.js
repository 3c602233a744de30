// The tables of a campaign: means with intervals, differences to the baseline, and every run.
import { el, table } from './dom.js';

/** A value in the unit of its metric. */
export function shown(style, value) {
  return Number.isFinite(value) ? (value * style.factor).toFixed(style.digits) : '–';
}

function withInterval(style, interval) {
  if (!interval) return '–';
  const mean = shown(style, interval.mean);
  const spread = Number.isFinite(interval.low) && interval.low < interval.high;
  return spread ? `${mean} [${shown(style, interval.low)}, ${shown(style, interval.high)}]` : mean;
}

export function drawGroups({ groups, columns, styles }, parent) {
  const rows = groups.map((group) => [
    group.input, group.variant, group.cells, ...columns.map((name) => withInterval(styles[name], group.metrics[name])),
  ]);
  parent.append(el('h2', {}, 'Results'), table(['input', 'variant', 'runs', ...columns.map((name) => styles[name]?.label ?? name)], rows));
  parent.append(el('p', { class: 'hint' }, 'Means over the runs, in brackets the bootstrap 95 % interval of the mean.'));
}

export function drawComparisons({ comparisons, baseline, columns, styles }, parent) {
  const rows = comparisons.filter((c) => columns.includes(c.metric)).map((c) => [
    c.input, c.variant, styles[c.metric].label, c.difference.count, withInterval(styles[c.metric], c.difference),
    c.p_value < 0.001 ? '< 0.001' : c.p_value.toFixed(3),
  ]);
  if (rows.length === 0) {
    parent.hidden = true;
    return;
  }
  parent.append(el('h2', {}, `Difference to ${baseline}`),
    table(['input', 'variant', 'metric', 'pairs', 'difference [95 %]', 'p'], rows),
    el('p', { class: 'hint' }, 'Same input, same seed. p: sign-flip test, two-sided.'));
}

export function drawCells({ results, columns, styles }, parent) {
  const rows = results.map((r) => [r.input, r.variant, r.seed, ...columns.map((name) => shown(styles[name] ?? { factor: 1, digits: 2 }, r.metrics[name])), r.command]);
  const header = ['input', 'variant', 'seed', ...columns.map((name) => styles[name]?.label ?? name), 'command'];
  parent.append(el('details', {}, el('summary', {}, 'Every run'), table(header, rows)));
}
