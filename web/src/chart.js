// The parts of ECharts that the report uses (the bundle holds no others), and what all charts share.
import { init, use, connect } from 'echarts/core';
import { BarChart, LineChart } from 'echarts/charts';
import { DataZoomInsideComponent, GridComponent, LegendPlainComponent, TooltipComponent } from 'echarts/components';
import { CanvasRenderer } from 'echarts/renderers';
import { el } from './dom.js';
import { color, onThemeChange } from './theme.js';

use([BarChart, LineChart, DataZoomInsideComponent, GridComponent, LegendPlainComponent, TooltipComponent, CanvasRenderer]);

const kGroup = 'time';
const kFont = 'system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", sans-serif';

export const charts = [];

/** Adds a chart to `parent`. `options()` is asked again whenever the colours change. */
export function addChart(parent, { height = 240, options, label, overTime = false }) {
  const box = el('div', { class: 'chart', style: `height:${height}px`, role: 'img', 'aria-label': label });
  parent.append(box);
  const chart = init(box, null, { renderer: 'canvas' });
  if (overTime) {
    chart.group = kGroup;
    connect(kGroup);
  }
  const draw = () => {
    chart.resize();
    chart.setOption({ animation: false, textStyle: { fontFamily: kFont }, ...options() }, { notMerge: true });
  };
  draw();
  onThemeChange.add(draw);
  new ResizeObserver(() => chart.resize()).observe(box);
  charts.push({ label, chart });
  return { chart, box };
}

/** An axis in the colours of the page; `name` holds the unit. */
export function axis(name, more = {}) {
  const text = color('muted');
  const line = { lineStyle: { color: color('grid') } };
  return {
    type: 'value', name, nameLocation: 'middle', nameTextStyle: { color: text, fontSize: 12 },
    axisLabel: { color: text, fontSize: 11, hideOverlap: true }, axisLine: line, axisTick: line, splitLine: line,
    ...more,
  };
}

export const yAxis = (name, more = {}) => axis(name, { nameGap: 46, splitNumber: 4, min: 0, ...more });

export function grid(more = {}) {
  return { left: 64, right: 20, top: 12, bottom: 42, ...more };
}

export function legend() {
  return { top: 0, right: 16, icon: 'roundRect', itemWidth: 14, itemHeight: 4, textStyle: { color: color('text'), fontSize: 12 } };
}

export function tooltip(more) {
  return {
    trigger: 'axis', confine: true, transitionDuration: 0, backgroundColor: color('card'), borderColor: color('line'),
    padding: 10, textStyle: { color: color('text'), fontSize: 12 },
    axisPointer: { type: 'line', lineStyle: { color: color('muted'), type: 'dashed' } }, ...more,
  };
}
