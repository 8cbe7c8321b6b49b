// The browser's motion sensors: whether there are any, and their samples as ten numbers each.

const FIRST_WITHIN = 3000; // ms until silence means that there are no sensors

/** What keeps this page from the sensors, as {title, text, code, link}; null: nothing that can be known beforehand. */
export function withheld() {
  if (!window.isSecureContext) {
    const secure = `https://${location.host}${location.pathname}`;
    return {
      title: "No sensors over plain HTTP",
      text:
        "Browsers give the motion sensors to pages that come over HTTPS only, and this one came over plain HTTP. Start the "
        + "server with --https, and scan its code again:",
      code: "poise live phone --host 0.0.0.0 --https",
      link: { href: secure + location.hash, text: `If it runs with --https already: ${secure}` },
    };
  }
  if (!("DeviceMotionEvent" in window)) {
    return { title: "No motion sensors", text: "This browser does not offer motion sensors to pages. Try Chrome or Safari on a phone." };
  }
  return null;
}

/** Asks where the browser wants to be asked, which must be in answer to a tap. Resolves to a problem, or null. */
export async function permission() {
  const kinds = [window.DeviceMotionEvent, window.DeviceOrientationEvent].filter((kind) => kind?.requestPermission);
  try {
    const answers = await Promise.all(kinds.map((kind) => kind.requestPermission()));
    if (answers.every((answer) => answer === "granted")) return null;
  } catch (error) {
    return { title: "The browser did not ask you", text: `It answered: ${error.message}. Tap Start again.` };
  }
  return {
    title: "Not permitted",
    text:
      "You, or this browser's settings, said no to motion and orientation. On an iPhone: close this tab, open the address "
      + "again, tap Start and then Allow. Elsewhere: the page's settings, beside its address, have Motion sensors.",
  };
}

/** Listens, and calls onSample(Float64Array(10)): time s; rotationRate alpha, beta, gamma; acceleration x, y, z; orientation. */
export class Sensors {
  constructor(onSample, onProblem) {
    this.onSample = onSample;
    this.onProblem = onProblem;
    this.orientation = [NaN, NaN, NaN];
    this.stamps = [];
    this.heard = false;
    this.told = false;
  }

  start() {
    addEventListener("devicemotion", this);
    addEventListener("deviceorientation", this);
    this.waiting = setTimeout(() => this.silent(), FIRST_WITHIN);
  }

  stop() {
    removeEventListener("devicemotion", this);
    removeEventListener("deviceorientation", this);
    clearTimeout(this.waiting);
  }

  handleEvent(event) {
    if (event.type === "deviceorientation") this.orientation = numbers(event, ["alpha", "beta", "gamma"]);
    else this.moved(event);
  }

  moved(event) {
    const acceleration = numbers(event.accelerationIncludingGravity, ["x", "y", "z"]);
    const rate = numbers(event.rotationRate, ["alpha", "beta", "gamma"]);
    if (acceleration.every(Number.isNaN)) return; // a browser without sensors says so by one empty event
    this.heard = true;
    if (rate.every(Number.isNaN)) return this.tell("No gyroscope",
      "This phone or browser gives accelerations but no rotation rate, without which no attitude can be followed.");
    const time = stamp(event);
    this.stamps.push(time);
    while (time - this.stamps[0] > 2) this.stamps.shift();
    this.onSample(Float64Array.of(time, ...rate, ...acceleration, ...this.orientation));
  }

  silent() {
    if (!this.heard && document.visibilityState === "visible") this.tell("No sensor answers",
      "No motion has come. Either this device has no motion sensors, or the browser's settings withhold them from all pages "
      + "(Android's Chrome: Settings, Site settings, Motion sensors).");
  }

  tell(title, text) {
    if (!this.told) this.onProblem({ title, text });
    this.told = true;
  }

  /** Samples a second of late. event.interval says it in ms or in s, depending on the browser, so it is counted. */
  rate() {
    const seconds = this.stamps.at(-1) - this.stamps[0];
    return seconds > 0.2 ? (this.stamps.length - 1) / seconds : NaN;
  }
}

function numbers(from, names) {
  return names.map((name) => (typeof from?.[name] === "number" ? from[name] : NaN));
}

/** s since 1970 by the clock that only goes forward. A browser that stamps events by another clock is not believed. */
function stamp(event) {
  const now = performance.now();
  const at = Math.abs(event.timeStamp - now) < 1000 ? event.timeStamp : now;
  return (performance.timeOrigin + at) / 1000;
}
