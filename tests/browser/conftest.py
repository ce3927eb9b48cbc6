"""Chromium, and servers of the page. `make browser` installs what is needed."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, ConsoleMessage, Page, expect, sync_playwright

from tests.browser.server import Server
from tests.support.paths import ROOT

SCREENSHOTS = ROOT / ".browser"
PATIENCE = 20_000
"""How long to wait for what a test expects, in milliseconds. The machine may be busy."""
expect.set_options(timeout=PATIENCE)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    assert chromium is not None, "install Chromium: apt-get install chromium"
    sandbox = [] if os.getuid() else ["--no-sandbox"]  # root has no sandbox
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=sandbox)
        yield browser
        browser.close()


@pytest.fixture
def serve(tmp_path: Path) -> Iterator[Callable[..., Server]]:
    """Starts a server on a file with a text."""
    servers: list[Server] = []

    def start(text: str, port: int = 0) -> Server:
        path = tmp_path / "rules.sleec"
        if not servers:
            path.write_text(text, encoding="utf-8")
        servers.append(Server(path, port))
        return servers[-1]

    yield start
    for server in servers:
        server.kill()


@pytest.fixture
def show(browser: Browser) -> Iterator[Callable[..., Page]]:
    """Opens a page of a server. What the page reports as an error on its console fails the test."""
    context = browser.new_context(viewport={"width": 1400, "height": 900})
    context.set_default_timeout(PATIENCE)
    complaints: list[str] = []

    def complain(message: ConsoleMessage) -> None:
        # A refused request, and a server that is gone on purpose, are not errors of the page.
        if message.type in ("error", "warning") and "Failed to load resource" not in message.text:
            complaints.append(message.text)

    def open_page(server: Server) -> Page:
        page = context.new_page()
        page.on("console", complain)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.goto(server.address)
        page.locator(".verdict").filter(has_text="contradict").or_(page.locator(".problem-title")).first.wait_for()
        return page

    yield open_page
    context.close()
    assert complaints == []
