// How often the error had which size.
import { addChart, axis, grid, tooltip, yAxis } from './chart.js';
import { card, el, tip } from './dom.js';
import { count, figure, lengthUnit } from './format.js';
import { color } from './theme.js';

function histogram(parent, title, { width, counts: within, beyond }, unit) {
  const counts = beyond > 0 ? [...within, beyond] : within;
  const step = width * unit.factor;
  const total = counts.reduce((a, b) => a + b, 0);
  const isBeyond = (i) => i >= within.length;
  const range = (i) => isBeyond(i) ? `≥ ${figure(i * step)} ${unit.name}` : `${figure(i * step)} – ${figure((i + 1) * step)} ${unit.name}`;
  const { element } = card(title);
  parent.append(element);
  addChart(element, {
    label: title,
    options: () => ({
      grid: grid(),
      xAxis: axis(`error [${unit.name}]${beyond > 0 ? `, the last bar: ${figure(within.length * step)} and more` : ''}`, { min: 0, max: counts.length * step, nameGap: 26, splitLine: { show: false }, axisLabel: { color: color('muted'), fontSize: 11, showMaxLabel: false } }),
      yAxis: yAxis('share of the poses [%]'),
      tooltip: tooltip({
        formatter: ([bar]) => tip(range(bar.dataIndex), [
          ['poses', count(counts[bar.dataIndex]), color(isBeyond(bar.dataIndex) ? 'error' : 'estimate')],
          ['share', `${figure(bar.value[1])} %`],
        ]),
      }),
      series: [{
        type: 'bar', barWidth: '92%', itemStyle: { color: color('estimate'), borderRadius: [2, 2, 0, 0] },
        data: counts.map((n, i) => ({
          value: [(i + 0.5) * step, 100 * n / total],
          itemStyle: isBeyond(i) ? { color: color('error') } : undefined,
        })),
      }],
    }),
  });
}

export function drawHistograms(run, parent) {
  if (!run.histograms) {
    const reason = run.reference
      ? 'The reference trajectory and the run share no instant, so there is no error to show. Do their clocks agree?'
      : 'This run has no reference trajectory, so there is no error to show. Give one with --reference FILE.';
    parent.prepend(el('p', { class: 'card wide sentence', id: 'no-errors' }, reason));
    return;
  }
  const { position, heading } = run.histograms;
  histogram(parent, 'Distribution of the position error', position, lengthUnit(position.width * position.counts.length));
  histogram(parent, 'Distribution of the heading error', heading, { name: '°', factor: 1 });
}
