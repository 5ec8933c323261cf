"""Uses replays in headless Chromium as a reader would, by the DevTools protocol over a pipe; needs nothing but Python.

check_replay.py SCREENSHOTS PAGE...
"""

import base64
import json
import os
import select
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent.parent / "src" / "suite" / "replay"

# Seconds any single answer may take.
PATIENCE = 60

# Milliseconds a frame may take while playing: far above what is seen, so that only a page that hangs fails.
SLOWEST_FRAME = 1000

# What is asked of the functions without side effects, on the recording of a page.
PURE = """
(recording) => {
  const replay = decode(recording);
  const faults = [];
  const demand = (holds, what) => { if (!holds) faults.push(what); };
  const last = lastPosition(replay);
  const isOrdered = replay.vertices.turns.length > 0;
  for (let position = 0; position <= last; position += 1) {
    const moment = momentAt(replay, position);
    const { title, text } = explain(replay, moment);
    demand(!/undefined|NaN|null|Infinity/.test(title + text), `words at ${position}: ${title}: ${text}`);
    const { bite, waiting } = moment;
    const serial = bite < 0 ? -1 : replay.chosen[bite];
    if (serial < 0) continue;
    demand(waiting.includes(serial), `vertex ${serial}, chosen at ${position}, does not wait`);
    demand(replay.vertices.gone[serial] === bite, `vertex ${serial}, chosen at ${position}, stays`);
    demand(!isOrdered || placeAmong(replay, serial, waiting) === 1, `vertex ${serial} is not the first at ${position}`);
    demand(replay.vertices.x[serial] === replay.x[bite] && replay.vertices.y[serial] === replay.y[bite],
      `the bite at ${position} is not centred on its vertex`);
  }
  demand(waitingBefore(replay, replay.count).length === 0, "front vertices wait after the last bite");
  const starts = stepStarts(replay).filter((start) => start >= 0);
  demand(starts.every((start, index) => index === 0 || start > starts[index - 1]), `steps start at ${starts}`);
  demand(starts.slice(1).every((start, index) => nextStep(replay, starts[index]) === start), "next step");
  demand(starts.slice(1).every((start, index) => previousStep(replay, start) === starts[index]), "previous step");
  const all = Object.keys(KINDS).reduce((sum, letter) => sum + countOf(replay, letter, last), 0);
  demand(all === replay.count, `${all} bites are counted`);
  return faults.slice(0, 5);
}
"""

# Draws, and keeps the pixels of the canvas under a name.
KEEP = """
((name) => {
  window.replay.draw();
  const { canvas } = window.replay.picture;
  // Of a copy: a canvas that is read often is drawn another way.
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
  copy.fillStyle = window.replay.picture.colours.page;
  copy.fillRect(0, 0, canvas.width, canvas.height);
  copy.drawImage(canvas, 0, 0);
  window.kept = { ...window.kept, [name]: copy.getImageData(0, 0, canvas.width, canvas.height).data };
})
"""

# The largest difference of any channel of any pixel between two pictures kept.
DIFFER = """
((one, other) => {
  const [left, right] = [window.kept[one], window.kept[other]];
  if (left.length !== right.length) return 255;
  let most = 0;
  for (let i = 0; i < left.length; i += 1) most = Math.max(most, Math.abs(left[i] - right[i]));
  return most;
})
"""

# Two pictures whose channels differ by no more, out of 255, look the same: a circle drawn again has edges that are rounded
# otherwise.
SAME = 4

# Plays at full speed and gives the milliseconds between frames, and the bites played.
PLAY = """
(async () => {
  const { player } = window.replay;
  player.jump(1);
  player.speed = 1000;
  const frames = [];
  let before = performance.now();
  player.toggle();
  while (player.isPlaying && player.position < 1001) {
    const now = await new Promise(requestAnimationFrame);
    frames.push(now - before);
    before = now;
  }
  player.pause();
  return { frames: frames.slice(1), bites: player.position - 1 };
})()
"""

# Milliseconds of script for drawing positions one by one, forward and back.
STEP = """
(() => {
  const { player, draw } = window.replay;
  const time = (from, by, count) => {
    player.jump(from);
    draw();
    const start = performance.now();
    for (let step = 0; step < count; step += 1) { player.step(by); draw(); }
    return (performance.now() - start) / count;
  };
  const middle = Math.floor(player.replay.count / 2);
  const count = Math.min(200, middle - 1);
  return { forward: time(middle, 1, count), back: time(middle, -1, count) };
})()
"""


class Browser:
    """A headless Chromium with one page."""

    def __init__(self, profile):
        to_child, ours_out = os.pipe()
        ours_in, from_child = os.pipe()
        command = [
            "chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
            "--no-first-run", "--disable-background-networking", "--remote-debugging-pipe", f"--user-data-dir={profile}",
        ]
        # The protocol wants descriptors 3 and 4.
        self.process = subprocess.Popen(
            ["bash", "-c", 'exec "$@" 3<&"$0" 4>&"$1"'.replace('"$@"', '"${@:2}"'), str(to_child), str(from_child), *command],
            pass_fds=(to_child, from_child), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        os.close(to_child)
        os.close(from_child)
        self.out, self.input = ours_out, ours_in
        self.buffer, self.number, self.session = b"", 0, None
        self.faults, self.requests = [], []
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Runtime", "Log", "Page", "Network"):
            self.ask(f"{domain}.enable")

    def ask(self, method, **parameters):
        """Sends a command and waits for its answer."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + PATIENCE
        while True:
            answer = self.read(deadline)
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise SystemExit(f"{method}: {answer['error']}")
                return answer["result"]

    def read(self, deadline):
        """The next message; notes errors and requests in it."""
        while b"\0" not in self.buffer:
            ready, _, _ = select.select([self.input], [], [], max(0, deadline - time.monotonic()))
            chunk = os.read(self.input, 1 << 20) if ready else b""
            if not chunk:
                raise SystemExit("Chromium does not answer")
            self.buffer += chunk
        message, self.buffer = self.buffer.split(b"\0", 1)
        event = json.loads(message)
        self.note(event.get("method"), event.get("params", {}))
        return event

    def note(self, method, told):
        if method == "Runtime.exceptionThrown":
            self.faults.append(json.dumps(told["exceptionDetails"])[:600])
        elif method == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
            self.faults.append(json.dumps(told["args"])[:600])
        elif method == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            self.faults.append(told["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(told["request"]["url"][:100])

    def evaluate(self, expression):
        """The value of an expression in the page."""
        result = self.ask("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise SystemExit(f"{expression[:200]}\n{result['exceptionDetails']}")
        return result["result"].get("value")

    def open(self, url, width=1280, height=860, ratio=1, mobile=False, scheme="light"):
        """Opens a page in a window of that size, and waits until it has drawn."""
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=ratio, mobile=mobile)
        self.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        self.ask("Page.navigate", url="about:blank")
        self.ask("Page.navigate", url=url)
        deadline = time.monotonic() + PATIENCE
        while not self.evaluate("document.readyState === 'complete' && Boolean(window.replay)"):
            if time.monotonic() > deadline:
                raise SystemExit(f"{url} does not start: {self.faults}")
            time.sleep(0.05)
        self.settle()

    def settle(self):
        """Waits for two frames."""
        self.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))")

    def key(self, key, text="", shift=False):
        for kind in ("keyDown", "keyUp"):
            code = {" ": "Space"}.get(key, key)
            told = {"text": text} if text and kind == "keyDown" else {}
            self.ask("Input.dispatchKeyEvent", type=kind, key=key, code=code, modifiers=8 if shift else 0, **told)
        self.settle()

    def mouse(self, kind, x, y, **more):
        self.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def screenshot(self, path):
        self.settle()
        path.write_bytes(base64.b64decode(self.ask("Page.captureScreenshot", format="png")["data"]))

    def close(self):
        try:
            self.ask("Browser.close")
        finally:
            self.process.wait(timeout=PATIENCE)


def demand(holds, what):
    if not holds:
        raise SystemExit(f"check_replay: {what}")


def position(browser):
    return browser.evaluate("window.replay.player.position")


def go(browser, where):
    """Goes to a position, or to where an expression of `player` and `replay` has it."""
    browser.evaluate(f"(({{ player, replay }}) => player.jump({where}))(window.replay)")
    browser.settle()


def check_functions(browser, recording):
    scripts = "\n".join((SCRIPTS / name).read_text() for name in ("state.js", "words.js"))
    faults = browser.evaluate(f"{{ {scripts}\n globalThis.faults = ({PURE})({recording}); }} globalThis.faults")
    demand(not faults, f"state.js and words.js: {faults}")


def keep(browser, name):
    browser.evaluate(f"{KEEP}({json.dumps(name)})")


def differ(browser, one, other="now"):
    """How much the picture differs from one kept; without another, what is drawn now."""
    if other == "now":
        keep(browser, "now")
    return browser.evaluate(f"{DIFFER}({json.dumps(one)}, {json.dumps(other)})")


def check_stepping(browser, count):
    """Steps change the picture, and coming back to a position gives the same one, whichever way."""
    places = sorted({0, 1, 2, count // 3, count // 2, count - 1, count, count + 1})
    for where in places:
        go(browser, where)
        keep(browser, str(where))
    for before, after in zip(places, places[1:]):
        demand(differ(browser, str(before), str(after)) > 10 * SAME, f"positions {before} and {after} look alike")
    for where in reversed(places):
        go(browser, where)
        demand(differ(browser, str(where)) <= SAME, f"position {where} looks otherwise after going back to it")
    for start in (count // 3, count // 2):
        go(browser, start)
        for by in (1, 1, 1, -1, -1, -1):
            browser.evaluate(f"window.replay.player.step({by}); window.replay.draw()")
        demand(differ(browser, str(start)) <= SAME, f"three bites forward and three back from {start} change the picture")


def check_keys(browser, count):
    go(browser, 0)
    steps = [("ArrowRight", {}, 1), ("ArrowRight", {"shift": True}, 11), ("ArrowLeft", {}, 10), ("End", {}, count + 1), ("Home", {}, 0)]
    for key, more, wanted in steps:
        browser.key(key, **more)
        demand(position(browser) == wanted, f"{key} leads to {position(browser)}, not to {wanted}")
    browser.key("n", "n")
    demand(position(browser) == 1, "N does not lead to vertex protection")
    browser.key("n", "n")
    demand("Edge protection" in browser.evaluate("document.querySelector('[aria-current]').textContent"), "edge protection is not marked")
    before = browser.evaluate("window.replay.player.speed")
    browser.key("+", "+")
    faster = browser.evaluate("window.replay.player.speed")
    browser.key("-", "-")
    demand(faster > before == browser.evaluate("window.replay.player.speed"), "+ and - do not change the speed")
    browser.key(" ", " ")
    time.sleep(0.5)
    browser.key(" ", " ")
    demand(position(browser) > 1 and not browser.evaluate("window.replay.player.isPlaying"), "space does not play and pause")


def check_pointer(browser, count):
    go(browser, count // 2)
    keep(browser, "before")
    box = browser.evaluate("(({ left, top, width, height }) => ({ left, top, width, height }))(window.replay.picture.canvas.getBoundingClientRect())")
    at = browser.evaluate(
        "(({ replay, picture }) => ({ x: picture.view.x(replay.x[0]) / picture.ratio, y: picture.view.y(replay.y[0]) / picture.ratio }))(window.replay)")
    x, y = box["left"] + at["x"], box["top"] + at["y"]
    browser.mouse("mouseMoved", x, y)
    browser.settle()
    hint = browser.evaluate("document.getElementById('hint').hidden ? '' : document.getElementById('hint').textContent")
    demand("radius" in hint or "waiting" in hint, f"pointing at a circle says {hint!r}")
    browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-400)
    time.sleep(0.5)
    demand(differ(browser, "before") > SAME, "the wheel does not zoom")
    browser.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
    browser.mouse("mouseMoved", x + 40, y + 30, button="left", buttons=1)
    browser.mouse("mouseReleased", x + 40, y + 30, button="left", clickCount=1)
    browser.mouse("mouseMoved", 2, 2)
    time.sleep(0.5)
    browser.key("0", "0")
    demand(differ(browser, "before") <= SAME, "0 does not bring the whole domain back")


def check_playing(browser, name):
    played = browser.evaluate(PLAY)
    frames = sorted(played["frames"])
    demand(played["bites"] >= min(700, browser.evaluate("window.replay.replay.count")), f"only {played['bites']} bites were played")
    demand(frames[-1] < SLOWEST_FRAME, f"a frame took {frames[-1]:.0f} ms")
    step = browser.evaluate(STEP)
    median, high = frames[len(frames) // 2], frames[int(0.95 * (len(frames) - 1))]
    print(f"{name}: {played['bites']} bites played at 1000 a second in {len(frames)} frames, median {median:.1f} ms, "
          f"95 % under {high:.1f} ms, longest {frames[-1]:.1f} ms; script a step: {step['forward']:.2f} ms forward, {step['back']:.2f} ms back")


def check_page(browser, path, shots):
    text = path.read_text()
    recording = text.split('type="application/json">', 1)[1].split("</script>", 1)[0]
    count = len(json.loads(recording)["bites"]["reasons"])
    name, url = path.stem, path.resolve().as_uri()
    browser.open(url)
    check_functions(browser, recording)
    check_stepping(browser, count)
    check_keys(browser, count)
    check_pointer(browser, count)
    check_playing(browser, name)
    go(browser, "player.replay.count + 1")
    demand("triangle" in browser.evaluate("document.getElementById('why-text').textContent"), "no triangles are told of at the end")
    keep(browser, "mesh")
    browser.evaluate("window.replay.picture.drawMesh = () => {}")
    demand(differ(browser, "mesh") > SAME, "no triangles are drawn at the end")
    take_screenshots(browser, url, name, count, shots)
    demand(not browser.faults, f"{path} complains: {browser.faults}")
    strangers = [request for request in browser.requests if not request.startswith(("file:", "data:", "about:"))]
    demand(not strangers, f"{path} asks for {strangers}")


def take_screenshots(browser, url, name, count, shots):
    """Pictures for whoever wants to look."""
    places = {"start": "0", "vertex": "3", "progressive": "1 + replay.reasons.indexOf('B', 20)", "middle": "1 + replay.reasons.indexOf('M')",
              "interior": f"{count // 2 + count // 8}", "mesh": "replay.count + 1"}
    browser.open(url)
    for place, where in places.items():
        go(browser, where)
        browser.screenshot(shots / f"{name}-{place}.png")
        if place in ("middle", "interior"):
            browser.key("z", "z")
            browser.screenshot(shots / f"{name}-{place}-near.png")
            browser.key("0", "0")
    browser.open(url, scheme="dark")
    go(browser, places["interior"])
    browser.screenshot(shots / f"{name}-dark.png")
    browser.open(url, width=390, height=844, ratio=2, mobile=True)
    go(browser, places["interior"])
    browser.screenshot(shots / f"{name}-narrow.png")


def main():
    shots, *pages = map(Path, sys.argv[1:])
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(profile)
        try:
            for page in pages:
                check_page(browser, page, shots)
        finally:
            browser.close()
    print(f"{len(pages)} replays hold; screenshots in {shots}")


main()
