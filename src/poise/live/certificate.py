"""Certificates for HTTPS: one that this machine makes for itself, or files of one's own."""

from __future__ import annotations

import datetime
import ipaddress
import os
import re
import socket
import ssl
from pathlib import Path
from typing import TYPE_CHECKING

from poise.errors import PoiseError
from poise.live.address import listens_everywhere, own_addresses

if TYPE_CHECKING:
    from cryptography import x509

_PUBLIC = re.compile(rb"-----BEGIN CERTIFICATE-----.*?-----END CERTIFICATE-----", re.DOTALL)
_DAYS, _RENEWED = 397, 14  # browsers take none that is valid for longer; days before the end that a new one is made


class CertificateError(PoiseError):
    """A certificate or key that cannot be used or made; the message names the file."""


def folder() -> Path:
    """Where this user's own certificate is kept."""
    config = os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config"
    return Path(config) / "poise"


def names_of(host: str, more: tuple[str, ...] = ()) -> list[str]:
    """The names and addresses that a server on *host* may be opened by."""
    own = socket.gethostname().lower()
    found = ["localhost", own, f"{own}.local", "127.0.0.1", "::1", *own_addresses(), *more]
    if not listens_everywhere(host):
        found.append(host.strip("[]"))
    return list(dict.fromkeys(found))


def own_certificate(names: list[str], where: Path | None = None) -> tuple[Path, Path]:
    """The certificate and key that this machine has made for itself; made anew where they do not cover all *names*, are
    about to expire or cannot be read.

    The key can be read by its owner only. Raises :class:`CertificateError` where the folder cannot be written to.
    """
    where = where or folder()
    paths = where / "live-certificate.pem", where / "live-key.pem"
    if not _serves(*paths, names):
        certificate, key = _made(names)
        try:
            where.mkdir(parents=True, exist_ok=True)
            for path, text, mode in ((paths[1], key, 0o600), (paths[0], certificate, 0o644)):
                _write(path, text, mode)
        except OSError as problem:
            raise CertificateError(
                f"{where}: the certificate for --https cannot be kept there ({problem.strerror}); "
                "give one of your own with --cert and --key"
            ) from None
    return paths


def check(certificate: Path, key: Path) -> tuple[Path, Path]:
    """Both files. Raises :class:`CertificateError` unless they can be read and belong together."""
    for path in (certificate, key):
        try:
            path.read_bytes()
        except OSError as problem:
            raise CertificateError(f"{path}: cannot be read: {problem.strerror}") from None
    try:
        ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER).load_cert_chain(certificate, key, password=_no_password)
    except ssl.SSLError as problem:
        reason = problem.reason or str(problem)
        if "MISMATCH" in reason:
            raise CertificateError(f"{key} is not the key of the certificate {certificate}") from None
        raise CertificateError(
            f"{certificate} and {key}: expected a certificate and its key in PEM format (the lines between "
            f"-----BEGIN CERTIFICATE----- and -----END …): {reason}"
        ) from None
    except _Locked:
        raise CertificateError(
            f"{key} is locked by a passphrase, which a server cannot ask for: "
            f"`openssl pkey -in {key} -out open.pem` makes one without"
        ) from None
    return certificate, key


def public_part(certificate: Path) -> bytes:
    """The certificates in the file, and not the key that it may hold, too."""
    return b"\n".join(_PUBLIC.findall(certificate.read_bytes())) + b"\n"


class _Locked(Exception):
    pass


def _no_password() -> str:
    raise _Locked


def _serves(certificate: Path, key: Path, names: list[str]) -> bool:
    from cryptography import x509

    try:
        check(certificate, key)
        found = x509.load_pem_x509_certificate(certificate.read_bytes())
        covered = found.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    except (OSError, PoiseError, ValueError, x509.ExtensionNotFound):
        return False
    soon = datetime.datetime.now(datetime.UTC) + datetime.timedelta(days=_RENEWED)
    return found.not_valid_after_utc > soon and all(_general(name) in covered for name in names)


def _made(names: list[str]) -> tuple[bytes, bytes]:
    """A certificate in PEM, signed by itself, and its key."""
    from cryptography import x509
    from cryptography.hazmat.primitives import hashes, serialization
    from cryptography.hazmat.primitives.asymmetric import ec
    from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

    key = ec.generate_private_key(ec.SECP256R1())
    subject = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, f"poise live on {socket.gethostname()}"[:64])])
    now = datetime.datetime.now(datetime.UTC)
    general = [_general(name) for name in names]
    usage = x509.KeyUsage(True, False, False, False, False, True, False, False, False)
    builder = (
        x509.CertificateBuilder(subject, subject, key.public_key(), x509.random_serial_number())
        .not_valid_before(now - datetime.timedelta(days=1))  # clocks of phones differ
        .not_valid_after(now + datetime.timedelta(days=_DAYS - 1))
        .add_extension(x509.SubjectAlternativeName(general), critical=False)
        .add_extension(x509.ExtendedKeyUsage([ExtendedKeyUsageOID.SERVER_AUTH]), critical=False)
        # iOS lets a person trust only what may sign; this one may sign for this machine and nobody else
        .add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
        .add_extension(usage, critical=True)
        .add_extension(x509.NameConstraints([_permitted(each) for each in general], None), critical=True)
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(key.public_key()), critical=False)
    )
    pem, plain = serialization.Encoding.PEM, serialization.NoEncryption()
    return (
        builder.sign(key, hashes.SHA256()).public_bytes(pem),
        key.private_bytes(pem, serialization.PrivateFormat.PKCS8, plain),
    )


def _general(name: str) -> x509.GeneralName:
    from cryptography import x509

    try:
        return x509.IPAddress(ipaddress.ip_address(name))
    except ValueError:
        return x509.DNSName(name.encode("idna").decode())


def _permitted(name: x509.GeneralName) -> x509.GeneralName:
    from cryptography import x509

    if isinstance(name, x509.IPAddress):
        return x509.IPAddress(ipaddress.ip_network(name.value))
    return name


def _write(path: Path, text: bytes, mode: int) -> None:
    """Beside, then renamed; from its first byte on only *mode* may read it."""
    part = path.with_name(f".{path.name}.{os.getpid()}")
    part.unlink(missing_ok=True)
    try:
        with os.fdopen(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode), "wb") as file:
            file.write(text)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
