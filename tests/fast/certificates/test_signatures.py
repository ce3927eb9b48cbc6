"""Signed certificates: made with the private half of a key, checked with the public one."""

from __future__ import annotations

import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import sleec_runtime
from sleec_runtime.errors import CertificateRefused, SleecError
from tests.support.cli import Cli
from tests.support.paths import ROOT
from tests.support.sessions import blocks

RULES = {
    "rules.sleec": "RULE a WHEN A THEN X\nRULE b WHEN B THEN NOT X UNLESS C IN WHICH CASE Y\nASSUME NOT (A AND B)\n"
}


@pytest.fixture
def keys(tmp_path: Path) -> dict[str, str]:
    """Two pairs of keys, one of another kind, and files that are none."""
    from cryptography.hazmat.primitives import serialization
    from cryptography.hazmat.primitives.asymmetric import ec, ed25519

    made: dict[str, ed25519.Ed25519PrivateKey | ec.EllipticCurvePrivateKey] = {
        "own": ed25519.Ed25519PrivateKey.generate(),
        "other": ed25519.Ed25519PrivateKey.generate(),
        "curve": ec.generate_private_key(ec.SECP256R1()),
    }
    pem = serialization.Encoding.PEM
    for name, key in made.items():
        private = key.private_bytes(pem, serialization.PrivateFormat.PKCS8, serialization.NoEncryption())
        (tmp_path / f"{name}.pem").write_bytes(private)
        public = key.public_key().public_bytes(pem, serialization.PublicFormat.SubjectPublicKeyInfo)
        (tmp_path / f"{name}.pub").write_bytes(public)
    (tmp_path / "none.pem").write_text("no key\n")
    return {path.name: str(path) for path in tmp_path.iterdir()}


def test_a_signature_that_fits(cli: Cli, keys: dict[str, str]) -> None:
    assert cli("certify", "rules.sleec", "-o", "c", "--sign", keys["own.pem"], files=RULES).code == 0
    ran = cli("certify", "--check", "c", "rules.sleec", "--key", keys["own.pub"])
    assert (ran.code, ran.err) == (0, "")
    assert "signed" in cli("certify", "--check", "c", "rules.sleec").err
    sleec_runtime.load("rules.sleec", certificate="c", key=keys["own.pub"])


def test_signatures_that_do_not_fit(cli: Cli, keys: dict[str, str], tmp_path: Path) -> None:
    cli("certify", "rules.sleec", "-o", "c", "--sign", keys["own.pem"], files=RULES)
    ran = cli("certify", "--check", "c", "rules.sleec", "--key", keys["other.pub"], "--format", "json")
    assert ran.code == 2
    assert '"reason": "signature"' in ran.out
    with pytest.raises(CertificateRefused, match="another key"):
        sleec_runtime.load("rules.sleec", certificate="c", key=keys["other.pub"])
    signature = tmp_path / "c" / "manifest.sig"
    written = signature.read_bytes()
    for wrong in (b"", b"!", written[:-4], written[4:], b"AAAA" + written[4:]):
        signature.write_bytes(wrong)
        assert cli("certify", "--check", "c", "rules.sleec", "--key", keys["own.pub"]).code == 2
    signature.write_bytes(written)
    manifest = tmp_path / "c" / "manifest.json"
    manifest.write_bytes(manifest.read_bytes() + b"\n")
    assert "was changed" in cli("certify", "--check", "c", "rules.sleec", "--key", keys["own.pub"]).err
    assert "is not what certify writes" in cli("certify", "--check", "c", "rules.sleec").err


def test_no_signature(cli: Cli, keys: dict[str, str]) -> None:
    cli("certify", "rules.sleec", "-o", "c", files=RULES)
    ran = cli("certify", "--check", "c", "rules.sleec", "--key", keys["own.pub"])
    assert (ran.code, "not signed" in ran.err) == (2, True)
    with pytest.raises(CertificateRefused, match="not signed"):
        sleec_runtime.load("rules.sleec", certificate="c", key=keys["own.pub"])


@pytest.mark.parametrize("name", ["own.pub", "curve.pem", "none.pem", "missing"])
def test_what_no_key_is_signs_nothing(cli: Cli, keys: dict[str, str], name: str, tmp_path: Path) -> None:
    ran = cli("certify", "rules.sleec", "-o", "c", "--sign", keys.get(name, name), files=RULES)
    assert ran.code == 2
    assert "error: " in ran.err
    assert not (tmp_path / "c").exists()


@pytest.mark.parametrize("name", ["own.pem", "curve.pub", "none.pem", "missing"])
def test_what_no_key_is_checks_nothing(cli: Cli, keys: dict[str, str], name: str) -> None:
    cli("certify", "rules.sleec", "-o", "c", "--sign", keys["own.pem"], files=RULES)
    assert cli("certify", "--check", "c", "rules.sleec", "--key", keys.get(name, name)).code == 2
    with pytest.raises(SleecError, match="key"):
        sleec_runtime.load("rules.sleec", certificate="c", key=keys.get(name, name))


def test_without_the_library_it_is_said_what_to_install(
    cli: Cli, keys: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    cli("certify", "rules.sleec", "-o", "c", "--sign", keys["own.pem"], files=RULES)
    for module in [name for name in sys.modules if name.startswith("cryptography")]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, "cryptography", None)
    for command in (
        ["rules.sleec", "-o", "d", "--sign", keys["own.pem"]],
        ["--check", "c", "rules.sleec", "--key", "k"],
    ):
        ran = cli("certify", *command)
        assert (ran.code, "pip install cryptography" in ran.err) == (2, True)
    with pytest.raises(SleecError, match="pip install cryptography"):
        sleec_runtime.load("rules.sleec", certificate="c", key=keys["own.pub"])
    sleec_runtime.load("rules.sleec", certificate="c")


@pytest.mark.skipif(shutil.which("openssl") is None, reason="openssl, which makes the keys, is not installed")
def test_the_example_of_the_page(cli: Cli, tmp_path: Path) -> None:
    cli("check", "rules.sleec", files={"rules.sleec": RULES["rules.sleec"].replace("RULE a", "DOMAIN ward\nRULE a")})
    page = ROOT / "docs" / "certificates.md"
    (commands, code) = (block.body for block in blocks(page.read_text("utf-8")) if block.language in ("sh", "python"))
    for line in commands.strip().splitlines():
        program, *arguments = shlex.split(line)
        if program == "sleec-verify":
            ran = cli(*arguments)
            assert (ran.code, ran.err) == (0, ""), line
        else:
            subprocess.run([program, *arguments], check=True, capture_output=True)
    names: dict[str, object] = {"sleec_runtime": sleec_runtime}
    exec(code, names)
    assert isinstance(names["sleec"], sleec_runtime.Sleec)
