"""Workbenches in processes of their own, files dropped on them, and requests that others send."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import urllib.error
import urllib.parse
import urllib.request

WAIT = 60_000
DROP = """([name, text]) => {
  const carried = new DataTransfer();
  carried.items.add(new File([text], name));
  document.dispatchEvent(new DragEvent("drop", { dataTransfer: carried, bubbles: true, cancelable: true }));
}"""
DROP_ALL = """(files) => {
  const carried = new DataTransfer();
  for (const [name, text] of files) carried.items.add(new File([text], name));
  document.dispatchEvent(new DragEvent("drop", { dataTransfer: carried, bubbles: true, cancelable: true }));
}"""
SOFTWARE = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"]


class Served:
    """A workbench; its address is what it printed."""

    def __init__(self, *files):
        command = [sys.executable, "-u", "-m", "synth.cli", "view", *map(str, files)]
        quiet = {**os.environ, "BROWSER": shutil.which("true") or "true"}
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=quiet)
        self.address = self.process.stdout.readline().split()[1]

    def asked(self, name, content, *edits, motion=False):
        """What the workbench says of a file: ``shown`` or ``error``; with `motion`, of one however large."""
        words = urllib.parse.urlencode(
            [("name", name), *(("edit", edit) for edit in edits), *[("motion", "yes")] * motion]
        )
        request = urllib.request.Request(f"{self.address}shown?{words}", data=content, method="POST")
        with urllib.request.urlopen(request, timeout=300) as answer:
            lines = [json.loads(line) for line in answer.read().splitlines() if line.strip()]
        return lines[-1]

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            return self.process.wait(timeout=20)
        finally:
            self.process.kill()
            self.process.communicate()


def opened(tab, bench):
    """Open a workbench in a tab."""
    tab.goto(bench.address)
    tab.wait_for_selector("main[data-ready]", timeout=WAIT)


def status(address, **headers):
    """Status of one request."""
    try:
        with urllib.request.urlopen(urllib.request.Request(address, headers=headers), timeout=20) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        return error.code
