"""A private authority, and a certificate with its key for each machine: a machine that has them may join the cluster.

Both ends of a connection show theirs. A certificate names its machine, but isn't tied to a host's name or address,
which change in a home network: Dask checks that the authority has signed it.
"""

import datetime
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mc_nested.errors import ClusterError

if TYPE_CHECKING:  # cryptography is the cluster extra's
    from cryptography.hazmat.primitives.asymmetric.ec import EllipticCurvePrivateKey
    from cryptography.x509 import Certificate, CertificateBuilder

AUTHORITY, AUTHORITY_KEY = "authority.pem", "authority-key.pem"
"""The authority's certificate, which every machine needs, and its key, which stays where it was made."""

CERTIFICATE, KEY = "certificate.pem", "key.pem"
"""A machine's own pair."""

LONGEST_NAME = 64
"""Characters that a certificate's name may have."""

VALID_DAYS = 3650
"""Days for which a new certificate is valid."""

_YESTERDAY = datetime.timedelta(days=1)
"""A machine's clock may be behind."""


def make_keys(folder: Path, machines: Sequence[str]) -> list[Path]:
    """Make a pair for each machine, in a folder of its name, and the authority if there is none; those folders.

    Key files can be read by their owner alone, where the system knows owners.

    Raises:
        ClusterError: a machine has a pair already, isn't a name for a folder, or half an authority is there.
        OSError: the disk refuses.
    """
    for machine in machines:
        is_reserved = machine in (AUTHORITY, AUTHORITY_KEY) or machine.startswith(".")
        if not machine or Path(machine).name != machine or is_reserved or len(machine) > LONGEST_NAME:
            raise ClusterError(f"{machine!r} can't be a machine's name, and a folder's: take letters and digits")
        if machines.count(machine) > 1:
            raise ClusterError(f"{machine} is named twice: give each machine a name of its own")
        if (folder / machine).exists():
            raise ClusterError(f"{folder / machine} is there already: delete it to make new keys, or take another name")
    authority, key = _authority_in(folder)
    for machine in machines:
        own = _new_key()
        _write_pair(folder / machine, (CERTIFICATE, _signed(machine, own, authority, key)), (KEY, own))
        _write(folder / machine / AUTHORITY, _pem_of(authority))
    return [folder / machine for machine in machines]


def _authority_in(folder: Path) -> "tuple[Certificate, EllipticCurvePrivateKey]":
    """Return the folder's authority and its key, made if there is none."""
    from cryptography import x509
    from cryptography.hazmat.primitives.asymmetric.ec import EllipticCurvePrivateKey
    from cryptography.hazmat.primitives.serialization import load_pem_private_key

    files = folder / AUTHORITY, folder / AUTHORITY_KEY
    if not any(file.exists() for file in files):
        key = _new_key()
        authority = _signed("mc-nested authority", key, None, key)
        _write_pair(folder, (AUTHORITY, authority), (AUTHORITY_KEY, key))
        return authority, key
    try:
        authority = x509.load_pem_x509_certificate(files[0].read_bytes())
        found = load_pem_private_key(files[1].read_bytes(), None)
    except (OSError, ValueError, TypeError) as error:
        raise ClusterError(
            f"{folder}: {AUTHORITY} and {AUTHORITY_KEY} are no whole authority: bring them back, or name a new folder"
        ) from error
    if not isinstance(found, EllipticCurvePrivateKey) or found.public_key() != authority.public_key():
        raise ClusterError(f"{folder}: {AUTHORITY_KEY} is another authority's: bring it back, or name a new folder")
    return authority, found


def _new_key() -> "EllipticCurvePrivateKey":
    from cryptography.hazmat.primitives.asymmetric import ec

    return ec.generate_private_key(ec.SECP256R1())


def _signed(
    name: str, own: "EllipticCurvePrivateKey", authority: "Certificate | None", key: "EllipticCurvePrivateKey"
) -> "Certificate":
    """Return a certificate for ``own``, signed with ``key``; an authority's if it signs itself."""
    from cryptography import x509
    from cryptography.hazmat.primitives import hashes
    from cryptography.x509.oid import NameOID

    subject = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)])
    now = datetime.datetime.now(datetime.timezone.utc)
    builder = (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(authority.subject if authority else subject)
        .public_key(own.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - _YESTERDAY)
        .not_valid_after(now + datetime.timedelta(days=VALID_DAYS))
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(own.public_key()), critical=False)
        .add_extension(x509.AuthorityKeyIdentifier.from_issuer_public_key(key.public_key()), critical=False)
    )
    return _with_uses(builder, is_authority=authority is None).sign(key, hashes.SHA256())


def _with_uses(builder: "CertificateBuilder", *, is_authority: bool) -> "CertificateBuilder":
    """Return the certificate's purposes, which Python 3.13 insists on: to sign others, or to talk as either end."""
    from cryptography import x509
    from cryptography.x509.oid import ExtendedKeyUsageOID

    uses = x509.KeyUsage(
        digital_signature=not is_authority,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        key_cert_sign=is_authority,
        crl_sign=is_authority,
        encipher_only=False,
        decipher_only=False,
    )
    limits = x509.BasicConstraints(ca=is_authority, path_length=0 if is_authority else None)
    builder = builder.add_extension(limits, critical=True).add_extension(uses, critical=True)
    if is_authority:
        return builder
    ends = [ExtendedKeyUsageOID.SERVER_AUTH, ExtendedKeyUsageOID.CLIENT_AUTH]
    return builder.add_extension(x509.ExtendedKeyUsage(ends), critical=False)


def _write_pair(
    folder: Path, certificate: "tuple[str, Certificate]", key: "tuple[str, EllipticCurvePrivateKey]"
) -> None:
    from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat

    folder.mkdir(parents=True, exist_ok=True)
    _write(folder / key[0], key[1].private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption()))
    _write(folder / certificate[0], _pem_of(certificate[1]))


def _pem_of(certificate: "Certificate") -> bytes:
    from cryptography.hazmat.primitives.serialization import Encoding

    return certificate.public_bytes(Encoding.PEM)


def _write(path: Path, content: bytes) -> None:
    path.touch(mode=0o600)
    path.write_bytes(content)
