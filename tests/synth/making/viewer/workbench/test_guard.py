"""Who asks the workbench, and what is answered: its own page gets in, nobody else does."""

import asyncio
import json
import random

import pytest

pytest.importorskip("starlette", reason="the workbench is not installed")

from starlette.responses import PlainTextResponse

from synth.making.viewer.workbench.app import MOST_BYTES, Guard, Place, Presence, application
from synth.making.viewer.workbench.asking import file_name
from synth.making.viewer.workbench.reading import answered as answer_of

PLACE = Place(8123, "T0ken-of-this_one")
OWN = [(b"host", b"127.0.0.1:8123")]


async def inside(scope, receive, send):
    await PlainTextResponse(f"inside {scope['path']}")(scope, receive, send)


async def answered(app, path, method, headers, query="", body=b""):
    """Status and text that an application answers one request with."""
    sent = []

    async def receive():
        return {"type": "http.request", "body": body, "more_body": False}

    async def send(message):
        sent.append(message)

    scope = {
        "type": "http", "method": method, "path": path, "raw_path": path.encode("utf-8", "surrogateescape"),
        "query_string": query.encode(), "headers": headers,
    }  # fmt: skip
    await app(scope, receive, send)
    return sent[0]["status"], sent[1]["body"].decode()


def asked(path="/T0ken-of-this_one/", headers=OWN, method="GET"):
    """Status and text of one request to the guard."""
    return asyncio.run(answered(Guard(inside, PLACE), path, method, headers))


def test_its_own_page_gets_in():
    assert asked() == (200, "inside /")
    origin = [*OWN, (b"origin", b"http://127.0.0.1:8123"), (b"sec-fetch-site", b"same-origin")]
    length = (b"content-length", b"17")
    assert asked("/T0ken-of-this_one/shown", [*origin, length], "POST") == (200, "inside /shown")


@pytest.mark.parametrize(
    "headers",
    [
        [],
        [(b"host", b"127.0.0.1:8124")],
        [(b"host", b"localhost:8123")],
        [(b"host", b"evil.example")],
        [*OWN, *OWN],
        [*OWN, (b"origin", b"http://evil.example")],
        [*OWN, (b"origin", b"null")],
        [*OWN, (b"Origin", b"http://127.0.0.1:9999")],
        [*OWN, (b"sec-fetch-site", b"cross-site")],
        [*OWN, (b"sec-fetch-site", b"same-site")],
    ],
)
def test_another_host_or_origin_does_not(headers):
    assert asked(headers=headers) == (403, "only the page of this workbench may send requests")


@pytest.mark.parametrize(
    "path",
    ["/", "", "/favicon.ico", "/T0ken-of-this_one", "/t0ken-of-this_one/", "/T0ken-of-this_on/", "//T0ken-of-this_one/",
     "/../T0ken-of-this_one/", "/T0ken-of-this_one.html", "/\udcff\udcfe/", "/é/"],
)  # fmt: skip
def test_nor_does_who_has_no_token(path):
    assert asked(path)[0] == 404


@pytest.mark.parametrize(
    ("length", "status"),
    [(None, 411), (b"-1", 411), (b"9" * 40, 411), (b"1e3", 411), (str(MOST_BYTES + 1).encode(), 413)],
)
def test_bodies_are_limited(length, status):
    headers = [*OWN, *([] if length is None else [(b"content-length", length)])]
    assert asked(headers=headers, method="POST")[0] == status


@pytest.mark.parametrize("method", ["PUT", "DELETE", "OPTIONS", "TRACE", "X"])
def test_other_methods_are_refused(method):
    assert asked(method=method)[0] == 405


@pytest.mark.parametrize("count", [500, pytest.param(10_000, marks=pytest.mark.slow)])
def test_malformed_requests_get_a_message_and_nothing_else(count):
    draw = random.Random(7)

    def noise(most):
        return bytes(draw.choices(range(256), k=draw.randrange(most)))

    for _ in range(count):
        path = "/" + noise(40).decode("utf-8", "surrogateescape")
        headers = [(draw.choice([b"host", b"origin", noise(8)]), noise(30)) for _ in range(draw.randrange(4))]
        status, text = asked(path, [*OWN, *headers] if draw.random() < 0.5 else headers, draw.choice(["GET", "POST"]))
        assert status in (403, 404)
        assert "inside" not in text


@pytest.mark.parametrize("count", [300, pytest.param(10_000, marks=pytest.mark.slow)])
def test_malformed_requests_of_its_own_page_get_a_message(count):
    """With the token, but with queries and bodies that are none: nothing is begun, nothing breaks."""
    draw = random.Random(11)
    app = application(PLACE, "the page", Presence(lambda: None))
    routes = ["", "shown", "template", "given", "open/", "../x", "%2e%2e/x", "shown/../given"]
    keys = ["edit", "edit", "kind", "size", "number", "motion", "x"]

    def word():
        letters = draw.choices(range(1, 256), k=draw.randrange(12))
        return "".join(f"%{letter:02x}" for letter in letters)

    async def story():
        for _ in range(count):
            query = "&".join(f"{draw.choice(keys)}={word()}" for _ in range(draw.randrange(4)))
            route, method = draw.choice(routes), draw.choice(["GET", "POST"])
            body = bytes(draw.choices(range(256), k=draw.randrange(20)))
            if route in ("shown", "template") and method == "POST":
                query += f"&edit=x{word()}"  # those would be judged
            headers = [*OWN, (b"content-length", str(len(body)).encode())]
            status, _ = await answered(app, f"/T0ken-of-this_one/{route}", method, headers, query, body)
            assert status in (200, 400, 404, 405)
            assert status != 200 or (route == "" and method == "GET")

    asyncio.run(story())


@pytest.mark.parametrize(
    "name", ["../../x.fold", "/etc/passwd", "..\\..\\x", "a\0b", "", "..", "-o", "x" * 9999 + ".fold", "\udcff"]
)
def test_names_of_files_stay_in_their_folder(name):
    made = file_name(name)
    assert made
    assert len(made) <= 120
    assert not set("/\\\0") & set(made)
    assert made[0] not in ".-"
    assert name[-5:] != ".fold" or made.endswith(".fold")


def test_it_ends_some_time_after_the_last_page_was_closed_and_not_at_a_reload():
    async def story():
        ended = []
        presence = Presence(lambda: ended.append(True), after=0.05)
        first = presence.line()
        await anext(first)
        await first.aclose()
        second = presence.line()
        await anext(second)  # a reload
        await asyncio.sleep(0.15)
        before = list(ended)
        await second.aclose()
        await asyncio.sleep(0.15)
        return before, ended

    assert asyncio.run(story()) == ([], [True])


def test_samples_are_listed_and_made_and_each_can_be_shown():
    app = application(PLACE, "page", Presence(lambda: None))
    status, text = asyncio.run(answered(app, f"/{PLACE.token}/samples", "GET", OWN))
    listed = json.loads(text)
    assert status == 200
    assert ".fold" in listed["formats"]
    for number, sample in enumerate(listed["samples"]):
        status, text = asyncio.run(answered(app, f"/{PLACE.token}/sample", "GET", OWN, f"number={number}"))
        assert status == 200
        assert answer_of(sample["name"], text.encode())["shown"]["moving"]["ways"]
    assert asyncio.run(answered(app, f"/{PLACE.token}/sample", "GET", OWN, "number=99"))[0] == 404
