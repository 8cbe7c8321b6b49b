// The page at /phone: a phone becomes a device of this server. Nothing here turns samples into an attitude.

import { Link } from "/phone/link.js";
import { Sensors, permission, withheld } from "/phone/sensors.js";

const $ = (id) => document.getElementById(id);
const SHOWN_EVERY = 250; // ms

let link = null, sensors = null, lock = null, hiddenSince = null, lastAttitude = 0, facing = null, showing = 0;

// -- before it starts

function token() {
  const found = new URLSearchParams(location.hash.slice(1)).get("token");
  if (found) {
    sessionStorage.setItem("poise-token", found);
    history.replaceState(null, "", location.pathname); // so that it is not seen, shared or bookmarked
  }
  const dashboards = sessionStorage.getItem("poise.token"); // of this tab, where the dashboard led here
  return found || sessionStorage.getItem("poise-token") || dashboards || "";
}

function usualName() {
  return localStorage.getItem("poise-name") || `phone-${Math.random().toString(36).slice(2, 6)}`;
}

function showProblem(problem) {
  $("problem").hidden = !problem;
  if (!problem) return;
  $("problem-title").textContent = problem.title;
  $("problem-text").textContent = problem.text;
  $("problem-code").hidden = !problem.code;
  $("problem-code").textContent = problem.code ?? "";
  $("problem-link").hidden = !problem.link;
  if (problem.link) Object.assign($("problem-link"), { href: problem.link.href, textContent: problem.link.text });
}

function showState(text, tone) {
  if ($("state").textContent !== text) $("state").textContent = text;
  $("state").dataset.tone = tone;
}

// -- running

async function start() {
  $("start").disabled = true;
  const refusal = await permission(); // first of all: iOS asks only while the tap is being answered
  $("start").disabled = false;
  showProblem(refusal);
  if (refusal) return;
  const name = $("name").value.trim();
  localStorage.setItem("poise-name", name);
  link = new Link(name, secret, showLink, hear);
  sensors = new Sensors((sample) => link.push(sample), showProblem);
  $("setup").hidden = true;
  $("running").hidden = false;
  $("notes").replaceChildren();
  $("hint").hidden = true;
  $("stop").focus({ preventScroll: true });
  lastAttitude = 0;
  facing = null;
  sensors.start();
  link.open();
  showLink(link);
  showing = setInterval(showNumbers, SHOWN_EVERY);
  stayAwake();
}

function stop() {
  sensors.stop();
  link.close();
  clearInterval(showing);
  lock?.release();
  lock = null;
  $("running").hidden = true;
  $("setup").hidden = false;
  showProblem(null);
  showState("Stopped", "idle");
  $("start").focus();
}

async function stayAwake() {
  try {
    lock = await navigator.wakeLock.request("screen");
  } catch {
    note("The screen may go dark by itself, and then samples stop: set it to stay on for longer.");
  }
}

function showLink({ state, problem, name }) {
  const socket = problem === "refused-socket";
  if (state === "on") showState(`Connected as ${name}`, "good");
  else if (state === "connecting") showState("Connecting …", "warn");
  else if (state === "refused") showState(socket ? "The server does not take this connection" : `Not taken: ${problem}`, "bad");
  else if (state === "lost") showState(`Not connected: ${problem}; trying again, samples are kept`, "warn");
  if (state !== "on") unknown();
  if (state === "refused" && socket) showProblem({
    title: "The browser does not open the connection",
    text:
      "The page came through, its WebSocket did not. Safari does this with a certificate that the phone does not trust: install "
      + "the server's own one (Settings, General, VPN & Device Management), trust it (Settings, General, About, Certificate Trust "
      + "Settings), then load this page again. If the name is not to the server's liking, choose another one.",
    link: location.protocol === "https:" ? { href: "/phone/certificate.crt", text: "The server's certificate" } : null,
  });
  else if (state === "on") showProblem(null);
}

function hear(message) {
  if (message.type === "attitude") showAttitude(message);
  else if (message.type === "axes") showAxes(message);
  else if (message.type === "error") note(`The server says: ${message.message}`);
  else if (message.type === "recording" && message.reason) note(`The server is not recording: ${message.reason}`);
}

function showAxes({ axes, reason }) {
  $("hint").hidden = Boolean(axes);
  $("hint").textContent = axes ? "" : `Which way this browser's sensors point is not known yet: ${reason}.`;
  if (!axes) return;
  const [acceleration, rates, unit] = axes.replaceAll("-", "−").split(",");
  note(`The motion shows: acceleration ${acceleration}, rates ${rates} (alpha, beta, gamma) in ${unit}/s.`);
}

function showAttitude(message) {
  lastAttitude = performance.now();
  const known = message.quat_wxyz.every((value) => value !== null);
  $("tilt").textContent = degrees(message.tilt_deg, 1);
  if (known) facing ??= message.heading_deg;
  $("heading").textContent = degrees(known ? (message.heading_deg - facing + 360) % 360 : null, 0);
  $("valid").textContent = message.valid ? "yes" : `no: ${message.flags.join(", ").toLowerCase().replaceAll("_", " ")}`;
  $("valid").dataset.tone = message.valid ? "good" : "bad";
  $("apart").textContent = message.apart_deg === null ? "–" : `${message.apart_deg.toFixed(1)}° off`;
  $("apart").dataset.tone = message.apart_deg > 30 ? "bad" : message.apart_deg > 10 ? "warn" : "";
  $("slab").dataset.known = known ? "yes" : "no";
  if (known) draw(message.quat_wxyz);
}

function unknown() {
  $("slab").dataset.known = "no";
  for (const id of ["tilt", "heading", "valid", "apart"]) {
    $(id).textContent = "–";
    delete $(id).dataset.tone;
  }
}

function showNumbers() {
  const { first, kept, next, acked, givenUp, recording } = link;
  const rate = sensors.rate();
  $("rate").textContent = Number.isFinite(rate) ? rate.toFixed(0) : "–";
  $("sent").textContent = next.toLocaleString("en");
  $("waiting").textContent = (first + kept.length - next).toLocaleString("en") + (givenUp ? ` (${givenUp} given up)` : "");
  $("acked").textContent = acked !== null ? acked.toLocaleString("en") : recording ? "0" : "not recording";
  if (performance.now() - lastAttitude > 1000) unknown();
}

/** Turns the drawn phone as the server's quaternion says, seen from where its top pointed away at the start. */
function draw([w, x, y, z]) {
  const turned = (facing * Math.PI) / 180;
  const body = [
    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
  ];
  const [c, s] = [Math.cos(turned), Math.sin(turned)];
  const [east, north, up] = [
    body[0].map((_, k) => c * body[0][k] - s * body[1][k]),
    body[0].map((_, k) => s * body[0][k] + c * body[1][k]),
    body[2],
  ];
  const rows = [east, up.map((v) => -v), north.map((v) => -v)]; // CSS: y downward, z towards the eye
  const column = (k, sign) => rows.map((row) => (sign * row[k]).toFixed(6)).join(",") + ",0";
  $("slab").style.transform = `rotateX(-18deg) matrix3d(${column(0, 1)},${column(1, -1)},${column(2, 1)},0,0,0,1)`;
}

function degrees(value, digits) {
  return value === null ? "–" : `${value.toFixed(digits)}°`;
}

function note(text) {
  const line = document.createElement("li");
  line.textContent = `${new Date().toLocaleTimeString()}: ${text}`;
  $("notes").prepend(line);
  while ($("notes").children.length > 6) $("notes").lastChild.remove();
}

function visibility() {
  if (!link || $("running").hidden) return;
  if (document.visibilityState === "hidden") {
    hiddenSince = performance.now();
    link.flush();
    link.note("the phone's page is hidden: its browser gives no samples until it is shown again");
  } else if (hiddenSince !== null) {
    const seconds = (performance.now() - hiddenSince) / 1000;
    hiddenSince = null;
    note(`This page was hidden for ${seconds.toFixed(0)} s; meanwhile the browser gave no samples.`);
    link.note(`the phone's page is shown again after ${seconds.toFixed(0)} s`);
    if (link.state === "lost") link.open();
    stayAwake();
  }
}

const refusal = withheld();
const secret = refusal ? "" : token();
$("server").textContent = location.host;
if (document.activeElement !== $("name")) $("name").value ||= usualName(); // what was, or is being, typed before this ran stays
$("setup").addEventListener("submit", (event) => { event.preventDefault(); start(); });
$("stop").addEventListener("click", stop);
document.addEventListener("visibilitychange", visibility);
addEventListener("pagehide", () => link?.flush());
showProblem(refusal);
$("setup").hidden = Boolean(refusal);
if (refusal) showState("Cannot start", "bad");
$("start").disabled = false; // before, the browser would have sent the form itself
