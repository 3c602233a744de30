// Look-ups in columns that are sorted by time.

/** Index of the last element of `t` that is not after `instant`; -1 before the first. */
export function indexAt(t, instant) {
  let low = 0;
  let high = t.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (t[middle] <= instant) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** Index of the element nearest in time; -1 in an empty column. */
export function nearest(t, instant) {
  const i = indexAt(t, instant);
  if (i < 0) return t.length > 0 ? 0 : -1;
  return i + 1 < t.length && t[i + 1] - instant < instant - t[i] ? i + 1 : i;
}

/** Pose at an instant, between the samples: position linear, heading along the shortest turn. */
export function poseAt(path, instant) {
  const i = indexAt(path.t, instant);
  if (i < 0 || path.t.length === 0) return undefined;
  if (i + 1 >= path.t.length) return instant > path.t[i] + 1 ? undefined : sample(path, i);
  const f = (instant - path.t[i]) / (path.t[i + 1] - path.t[i]);
  const turn = wrap(path.theta[i + 1] - path.theta[i]);
  return {
    x: path.x[i] + f * (path.x[i + 1] - path.x[i]),
    y: path.y[i] + f * (path.y[i + 1] - path.y[i]),
    theta: wrap(path.theta[i] + f * turn),
  };
}

export const wrap = (angle) => angle - 2 * Math.PI * Math.floor((angle + Math.PI) / (2 * Math.PI));

const sample = (path, i) => ({ x: path.x[i], y: path.y[i], theta: path.theta[i] });

/** Largest element, also of long columns (Math.max(...column) overflows the stack). */
export const largest = (column) => column.reduce((a, b) => Math.max(a, b), -Infinity);
export const smallest = (column) => column.reduce((a, b) => Math.min(a, b), Infinity);
