// Numbers as people read them. Everything arrives in SI units and radians.

export const kDegrees = 180 / Math.PI;

/** At most `digits` significant digits, without exponents for everyday sizes. */
export function figure(value, digits = 3) {
  if (value === undefined || value === null || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.floor(Math.log10(Math.abs(Number(value.toPrecision(digits)))));
  if (size < -4) return value.toExponential(1);
  return value.toFixed(Math.min(6, Math.max(0, digits - 1 - size)));
}

export const count = (value) => (Number.isFinite(value) ? Math.round(value).toLocaleString('en-US') : '–');
export const percent = (share) => (Number.isFinite(share) ? `${figure(100 * share, 3)} %` : '–');

/** The unit in which lengths up to `largest` metres are best shown. */
export function lengthUnit(largest) {
  return largest < 1 ? { name: 'cm', factor: 100 } : { name: 'm', factor: 1 };
}

export function length(metres) {
  if (!Number.isFinite(metres)) return '–';
  const unit = lengthUnit(Math.abs(metres));
  return `${figure(metres * unit.factor)} ${unit.name}`;
}

export const angle = (radians) => (Number.isFinite(radians) ? `${figure(radians * kDegrees)}°` : '–');

export function seconds(value) {
  if (!Number.isFinite(value)) return '–';
  if (value < 1) return `${figure(value * 1000)} ms`;
  if (value < 120) return `${figure(value)} s`;
  return `${Math.floor(value / 60)} min ${Math.round(value % 60)} s`;
}

/** Instant of the run: "12.3 s", and minutes as well in a long one. */
export function instant(t) {
  const plain = `${t.toFixed(1)} s`;
  if (t < 120) return plain;
  const whole = Math.floor(Number(t.toFixed(1)));
  return `${plain} (${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')} min)`;
}

export function bytes(value) {
  if (!Number.isFinite(value)) return '–';
  const units = ['B', 'KiB', 'MiB', 'GiB'];
  let i = 0;
  for (; value >= 1024 && i < 3; ++i) value /= 1024;
  return `${figure(value)} ${units[i]}`;
}

/** 1, 2 or 5 times a power of ten, not below `value`. */
export function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((step) => step * power).find((step) => step >= value * (1 - 1e-9));
}
