// Colours. The style sheet holds them as variables (light, dark, print); the canvases read them from there.

export function color(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

// Listeners are called when the colours change: by the system's setting, and for printing.
const listeners = [];

export const onThemeChange = {
  add(listener) { listeners.push(listener); },
  notify() { for (const listener of listeners) listener(); },
  notifyOnChange() {
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.notify());
    const print = (on) => () => {
      document.documentElement.classList.toggle('print', on);
      this.notify();
    };
    addEventListener('beforeprint', print(true));
    addEventListener('afterprint', print(false));
  },
};

// Matplotlib's "plasma" (CC0) at even steps: its lightness runs one way, so it reads in grey and for the colour-blind.
const kPlasma = ['#0d0887', '#5302a3', '#8b0aa5', '#b83289', '#db5c68', '#f48849', '#febd2a', '#f0f921'];

const channels = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));

function plasma(share) {
  const place = Math.min(1, Math.max(0, share)) * (kPlasma.length - 1);
  const i = Math.min(kPlasma.length - 2, Math.floor(place));
  const [a, b] = [channels(kPlasma[i]), channels(kPlasma[i + 1])];
  return `rgb(${a.map((v, k) => Math.round(v + (place - i) * (b[k] - v))).join(',')})`;
}

/** Colour of a share 0..1 of the scale: the end that would vanish in the background is left out. */
export function scaleColor(share) {
  return color('scheme') === 'dark' ? plasma(0.3 + 0.7 * share) : plasma(0.82 * share);
}

/** #rrggbb or rgb(r, g, b) as [r, g, b]. */
export function rgb(text) {
  return text.startsWith('#') ? channels(text) : text.match(/\d+/g).slice(0, 3).map(Number);
}
