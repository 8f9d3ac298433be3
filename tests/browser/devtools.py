"""A headless Chromium driven by the DevTools protocol over two pipes, with Python's standard library only.

    with Browser(program, profile) as browser:
        page = browser.open("file:///...", width, height)
        page.evaluate("1 + 1")
        page.picture()          # the visible part of the page, as a Picture

Complaints of the page (exceptions, errors on the console, violated policies, dialogs) are collected in
page.complaints, and its network requests in page.requests.
"""
import base64
import json
import os
import struct
import subprocess
import time
import zlib


class Picture:
    """Pixels of a PNG of 8 bits a channel, RGB or RGBA, as browsers make it."""

    def __init__(self, png):
        assert png[:8] == b"\x89PNG\r\n\x1a\n"
        at, data = 8, b""
        while at < len(png):
            length, kind = struct.unpack(">I4s", png[at:at + 8])
            body = png[at + 8:at + 8 + length]
            if kind == b"IHDR":
                self.width, self.height, depth, colour = struct.unpack(">IIBB", body[:10])
                assert depth == 8 and colour in (2, 6) and body[12] == 0
                self.channels = 3 if colour == 2 else 4
            elif kind == b"IDAT":
                data += body
            at += length + 12
        self.rows = self._unfilter(zlib.decompress(data))

    def _unfilter(self, data):
        n, size, rows, above = self.channels, self.width * self.channels, [], None
        above = bytearray(size)
        for y in range(self.height):
            start = y * (size + 1)
            kind, row = data[start], bytearray(data[start + 1:start + 1 + size])
            if kind == 1:
                for i in range(n, size):
                    row[i] = (row[i] + row[i - n]) & 255
            elif kind == 2:
                row = bytearray((a + b) & 255 for a, b in zip(row, above))
            elif kind == 3:
                for i in range(size):
                    row[i] = (row[i] + ((row[i - n] if i >= n else 0) + above[i]) // 2) & 255
            elif kind == 4:
                for i in range(size):
                    a, b, c = (row[i - n] if i >= n else 0), above[i], (above[i - n] if i >= n else 0)
                    pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                    row[i] = (row[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255
            rows.append(row)
            above = row
        return rows

    def at(self, x, y):
        i = int(x) * self.channels
        return tuple(self.rows[int(y)][i:i + 3])

    def farthest(self, other, left, right):
        """The largest difference of any channel in the columns from `left` up to `right`."""
        n = self.channels
        return max(abs(a - b) for mine, his in zip(self.rows, other.rows)
                   for a, b in zip(mine[left * n:right * n], his[left * n:right * n]))

    def difference(self, other):
        """The mean difference of channels, out of 255; and the share of pixels in which a channel differs by more
        than 64."""
        assert (self.width, self.height) == (other.width, other.height), "pictures of two sizes"
        total, far = 0, 0
        for y in range(self.height):
            for x in range(self.width):
                gaps = [abs(a - b) for a, b in zip(self.at(x, y), other.at(x, y))]
                total += sum(gaps)
                far += max(gaps) > 64
        pixels = self.width * self.height
        return total / (3 * pixels), far / pixels


class Page:
    def __init__(self, browser, session):
        self.browser, self.session, self.complaints, self.requests, self.loaded = browser, session, [], [], False

    def call(self, method, **parameters):
        return self.browser.call(method, parameters, self.session)

    def heard(self, method, parameters):
        if method == "Page.loadEventFired":
            self.loaded = True
        elif method == "Runtime.exceptionThrown":
            self.complaints.append("exception: " + json.dumps(parameters["exceptionDetails"].get("exception", {}).get("description")))
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning", "assert"):
            self.complaints.append("console: " + json.dumps(parameters["args"]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] in ("error", "warning"):
            self.complaints.append("log: " + parameters["entry"]["text"])
        elif method == "Page.javascriptDialogOpening":
            self.complaints.append("dialog: " + parameters["message"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(parameters["request"]["url"])

    def go(self, url):
        self.loaded = False
        self.call("Page.navigate", url=url)
        self.browser.wait(lambda: self.loaded)
        self.rest()

    def rest(self):
        """Waits until two frames have been drawn."""
        self.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def evaluate(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in answer, "%s: %s" % (expression, answer["exceptionDetails"])
        return answer["result"].get("value")

    def until(self, expression):
        deadline = time.monotonic() + 60
        while not self.evaluate(expression):
            assert time.monotonic() < deadline, "never so: " + expression
            time.sleep(0.05)

    def picture(self, selector=None):
        """A picture of the visible page, or of an element, which is scrolled into view. The window is not resized,
        since a page may depend on its size."""
        clip = {}
        if selector:
            box = self.evaluate("(() => { const e = document.querySelector(%s); e.scrollIntoView({block: 'center'});"
                                "const r = e.getBoundingClientRect(); return [r.left + scrollX, r.top + scrollY, r.width, r.height] })()" % json.dumps(selector))
            self.rest()
            clip = {"clip": dict(zip(("x", "y", "width", "height"), box), scale=1), "captureBeyondViewport": False}
        self.png = base64.b64decode(self.call("Page.captureScreenshot", format="png", **clip)["data"])
        return Picture(self.png)

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def press(self, key):
        text = {"text": key} if len(key) == 1 else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, **text)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key)


class Browser:
    def __init__(self, program, profile):
        self.program, self.profile, self.number, self.answers, self.pages, self.buffer = program, profile, 0, {}, {}, b""

    def __enter__(self):
        from_us, to_browser = os.pipe()
        from_browser, to_us = os.pipe()

        def place():  # the descriptors that the protocol requires: 3 to read from, 4 to write to
            first, second = os.dup(from_us), os.dup(to_us)
            os.dup2(first, 3)
            os.dup2(second, 4)

        self.process = subprocess.Popen(
            [self.program, "--headless=new", "--remote-debugging-pipe", "--user-data-dir=" + self.profile, "--no-sandbox",
             "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run", "--hide-scrollbars", "--force-color-profile=srgb",
             "--disable-background-networking", "--disable-component-update", "--mute-audio"],
            preexec_fn=place, close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(from_us)
        os.close(to_us)
        self.out, self.into = to_browser, from_browser
        return self

    def __exit__(self, *_):
        try:
            self.call("Browser.close", {})
            self.process.wait(20)
        except Exception:
            self.process.kill()
            self.process.wait()

    def _listen(self):
        while b"\0" not in self.buffer:
            more = os.read(self.into, 1 << 16)
            assert more, "the browser has ended"
            self.buffer += more
        message, self.buffer = self.buffer.split(b"\0", 1)
        message = json.loads(message)
        if "id" in message:
            self.answers[message["id"]] = message
        elif message.get("sessionId") in self.pages:
            page = self.pages[message["sessionId"]]
            page.heard(message["method"], message["params"])
            if message["method"] == "Page.javascriptDialogOpening":  # an open dialog blocks the page
                self._send("Page.handleJavaScriptDialog", {"accept": True}, page.session)

    def _send(self, method, parameters, session):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.out, data):]
        return self.number

    def call(self, method, parameters, session=None):
        number = self._send(method, parameters, session)
        while number not in self.answers:
            self._listen()
        answer = self.answers.pop(number)
        assert "error" not in answer, "%s: %s" % (method, answer["error"])
        return answer["result"]

    def wait(self, true):
        while not true():
            self._listen()

    def open(self, url, width, height, scripts=True, dark=False):
        target = self.call("Target.createTarget", {"url": "about:blank"})["targetId"]
        session = self.call("Target.attachToTarget", {"targetId": target, "flatten": True})["sessionId"]
        page = self.pages[session] = Page(self, session)
        for domain in ("Page", "Runtime", "Log", "Network"):
            page.call(domain + ".enable")
        page.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        page.call("Emulation.setScriptExecutionDisabled", value=not scripts)
        if scripts:
            page.go(url)
        else:
            page.call("Page.navigate", url=url)
            self.wait(lambda: page.loaded)
        return page
