"""HTTPS with a certificate of this machine's own, and the address and QR code for a phone."""

from __future__ import annotations

import datetime
import io
import os
import re
import ssl
import stat
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest
from cryptography import x509
from cryptography.hazmat.primitives import serialization

from live_helpers import serving
from poise.cli.phone import addresses, tell_phone
from poise.live import certificate
from poise.live.access import SCOPES
from poise.live.address import for_phones, own_addresses, show_qr, svg_qr
from poise.live.certificate import CertificateError, check, own_certificate, public_part
from poise.live.listening import Options

NAMES = ["localhost", "127.0.0.1", "box.local", "::1"]
DEVICE, WRITE = "device-token-of-16", "writing-token-of-16"


def loaded(path: Path) -> x509.Certificate:
    return x509.load_pem_x509_certificate(path.read_bytes())


def test_the_certificate_is_kept_until_it_no_longer_serves(tmp_path: Path, monkeypatch: Any) -> None:
    files = own_certificate(NAMES, tmp_path / "config")
    assert stat.S_IMODE(files[1].stat().st_mode) == 0o600
    first = loaded(files[0])
    assert loaded(own_certificate(NAMES[:2], tmp_path / "config")[0]) == first
    more = loaded(own_certificate([*NAMES, "192.168.1.5"], tmp_path / "config")[0])
    assert more != first
    names = more.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    assert "192.168.1.5" in [str(each) for each in names.get_values_for_type(x509.IPAddress)]
    assert more.not_valid_after_utc - more.not_valid_before_utc <= datetime.timedelta(days=397)
    monkeypatch.setattr(certificate, "_DAYS", certificate._RENEWED)  # it is about to expire
    own_certificate([*NAMES, "10.0.0.9"], tmp_path / "config")
    expiring = loaded(files[0])
    monkeypatch.undo()
    assert loaded(own_certificate(NAMES, tmp_path / "config")[0]) != expiring
    files[1].write_text("no key")
    check(*own_certificate(NAMES, tmp_path / "config"))
    assert not [path for path in files[0].parent.iterdir() if path not in files]


def test_a_folder_that_cannot_be_written_to_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(CertificateError, match="cannot be kept there"):
        own_certificate(NAMES, tmp_path / "file" / "poise")


def test_a_client_that_trusts_it_needs_no_exception(tmp_path: Path) -> None:
    files = own_certificate(NAMES, tmp_path)
    trusting = ssl.create_default_context(cafile=str(files[0]))
    with serving(certificate=files) as running:
        port = running.server.options.port
        for name in ("localhost", "127.0.0.1"):
            found = httpx.get(f"https://{name}:{port}/phone", verify=trusting)
            assert found.status_code == 200
            assert "script-src 'self'" in found.headers["content-security-policy"]
            assert "<script type=" in found.text
            assert not re.search(r"<script>|<style|style=|onclick|https?://(?!localhost)", found.text)
        with pytest.raises(httpx.ConnectError):
            httpx.get(f"https://127.0.0.1:{port}/phone")
        given = httpx.get(f"https://127.0.0.1:{port}/phone/certificate.crt", verify=trusting)
        assert x509.load_pem_x509_certificate(given.content) == loaded(files[0])
        for path in ("../certificate.py", "..%2fcertificate.py", "%2e%2e/certificate.py"):
            assert httpx.get(f"https://127.0.0.1:{port}/phone/{path}", verify=trusting).status_code == 404


def test_a_key_in_the_certificates_file_is_not_given_away(tmp_path: Path) -> None:
    files = own_certificate(NAMES, tmp_path)
    both = tmp_path / "both.pem"
    both.write_bytes(files[1].read_bytes() + files[0].read_bytes())
    check(both, both)
    assert public_part(both).strip() == files[0].read_bytes().strip()


def test_bad_files_are_named(tmp_path: Path) -> None:
    own, other = own_certificate(NAMES, tmp_path / "a"), own_certificate(NAMES, tmp_path / "b")
    locked, text = tmp_path / "locked.pem", tmp_path / "text.pem"
    key = serialization.load_pem_private_key(own[1].read_bytes(), None)
    hidden = serialization.BestAvailableEncryption(b"secret")
    locked.write_bytes(key.private_bytes(serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, hidden))
    text.write_text("hello")
    for cert, private, said in (
        (tmp_path / "none.pem", own[1], "none.pem: cannot be read: No such file"),
        (own[0], other[1], "is not the key of the certificate"),
        (own[0], locked, "locked by a passphrase"),
        (text, own[1], "expected a certificate and its key in PEM"),
        (own[0], text, "expected a certificate and its key in PEM"),
    ):
        with pytest.raises(CertificateError, match=said):
            check(cert, private)


def test_the_qr_code_is_for_those_who_may_write() -> None:
    tokens = {DEVICE: frozenset({"device"}), WRITE: frozenset({"write"}), "reading-token-of-16": frozenset({"read"})}
    with serving(host="0.0.0.0", tokens=tokens, phone_token=DEVICE) as running:
        url = f"http://127.0.0.1:{running.server.options.port}/phone/qr.svg"
        for token, status in ((WRITE, 200), (DEVICE, 401), ("reading-token-of-16", 401), ("", 401)):
            found = httpx.get(url, headers={"Authorization": f"Bearer {token}"} if token else {})
            expected = status if own_addresses() or status != 200 else 404
            assert found.status_code == expected
        if own_addresses():
            found = httpx.get(url, headers={"Authorization": f"Bearer {WRITE}"})
            assert found.headers["content-type"] == "image/svg+xml"
            assert found.headers["cache-control"] == "no-store"
            assert DEVICE not in found.text
    with serving() as running:
        answer = running.http.get("/phone/qr.svg")
        assert answer.status_code == 404
        assert "--host 0.0.0.0 --https" in answer.json()["error"]


def modules(picture: str) -> np.ndarray[Any, Any]:
    """The dark modules of a code that was drawn with half blocks of light."""
    light = {" ": (0, 0), "▀": (1, 0), "▄": (0, 1), "█": (1, 1)}
    lines = picture.splitlines()
    rows = [[light[char][half] for char in line] for line in lines for half in (0, 1)]
    return 1 - np.array(rows)


def test_terminal_and_picture_hold_the_address() -> None:
    link = f"https://192.168.1.5:8760/phone#token={DEVICE}"
    out = io.StringIO()
    show_qr(link, out)
    picture = re.sub(r"\x1b\[[\d;]*m", "", out.getvalue())
    lines = picture.splitlines()
    assert len({len(line) for line in lines}) == 1
    assert max(len(lines[0]), 2 * len(lines)) <= 48  # fits into a terminal of 80 × 24
    dark = modules(picture)
    finder = dark[2:9, 2:9]
    assert finder[0].all() and finder[:, 0].all() and finder[2:5, 2:5].all() and not finder[1, 1:6].any()
    import segno

    size = len(lines[0])
    np.testing.assert_array_equal(dark[:size], list(segno.make(link, error="l", micro=False).matrix_iter(border=2)))
    assert svg_qr(link).startswith(b"<svg")


def test_what_is_printed_for_a_phone(capsys: pytest.CaptureFixture[str]) -> None:
    certificate = (Path("c"), Path("k"))
    beyond = Options("192.168.1.5", 8760, {DEVICE: frozenset({"device"})}, (), certificate, DEVICE)
    assert for_phones(beyond) == f"https://192.168.1.5:8760/phone#token={DEVICE}"
    assert for_phones(Options("2001:db8::5", 1, {}, (), None, "t")) == "http://[2001:db8::5]:1/phone#token=t"
    assert for_phones(Options(phone_token=DEVICE)) is None
    assert for_phones(Options("192.168.1.5")) is None
    out = io.StringIO()
    tell_phone(beyond, out)
    assert out.getvalue() == f"a phone opens https://192.168.1.5:8760/phone#token={DEVICE}\n"  # no code: no terminal
    tell_phone(Options("192.168.1.5", phone_token=DEVICE), io.StringIO())
    assert "no sensors at all" in capsys.readouterr().err
    tell_phone(Options(), io.StringIO())
    assert "poise live phone --host 0.0.0.0 --https" in capsys.readouterr().err
    made = Options("0.0.0.0", 1, {"made": frozenset(SCOPES)}, made_token="made")
    assert next(addresses(made)).startswith("poise live on http://127.0.0.1:1/#token=made ")


@contextmanager
def command(*words: str, config: Path) -> Iterator[subprocess.Popen[str]]:
    environment = {**os.environ, "XDG_CONFIG_HOME": str(config)}
    environment.pop("POISE_TOKEN", None)
    with subprocess.Popen(
        [sys.executable, "-m", "poise", "live", *words, "-m", "adaptive-gain", "--port", "0"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
    ) as process:
        try:
            yield process
        finally:
            process.terminate()
            process.wait(30)


def test_one_command_serves_a_phone(tmp_path: Path) -> None:
    if not own_addresses():
        pytest.skip("this machine is in no network")
    with command("phone", "--host", "0.0.0.0", "--https", config=tmp_path) as process:
        assert process.stdout is not None
        lines = [process.stdout.readline() for _ in range(3)]
        board = re.match(r"poise live on (https://127\.0\.0\.1:\d+)/#token=(\w+) ", lines[0])
        phone = re.match(r"a phone opens (https://\S+)/phone#token=(\w+)\n", lines[2])
        assert board is not None
        assert phone is not None
        trusting = ssl.create_default_context(cafile=str(tmp_path / "poise" / "live-certificate.pem"))
        assert httpx.get(f"{phone[1]}/phone", verify=trusting).status_code == 200
        statuses = [
            httpx.get(f"{board[1]}/devices", verify=trusting, headers={"Authorization": f"Bearer {token}"}).status_code
            for token in (board[2], phone[2])
        ]
        assert statuses == [200, 401]  # a phone's token is for pushing


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (("--cert", "c.pem"), 2, "--cert and --key belong together"),
        (("--cert", "none.pem", "--key", "none.pem"), 1, "none.pem: cannot be read"),
        (("--host", "0.0.0.0", "--https"), 2, "give --token"),
    ],
)
def test_mistakes_end_with_one_line(tmp_path: Path, words: tuple[str, ...], code: int, said: str) -> None:
    with command(*words, config=tmp_path) as process:
        out, problem = process.communicate(timeout=60)
        assert process.returncode == code
    assert out == ""
    assert said in problem
    assert problem.count("\n") == 1
