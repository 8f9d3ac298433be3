"""Writes the wheel of the package: wheel.py FOLDER LICENSE VERSION WHEEL

FOLDER has the extension module and the package's own files. The tags of the wheel are in its name. Equal contents give
equal bytes.
"""
import base64
import hashlib
import pathlib
import sys
import zipfile

SUMMARY = "Exact Minkowski sums and provably small displacement of map features"


def main():
    folder, licence, version, wheel = sys.argv[1:]
    tag = pathlib.Path(wheel).stem.split("-", 2)[2]
    info = f"sunder-{version}.dist-info"
    files = {f"sunder/{path.name}": path.read_bytes() for path in sorted(pathlib.Path(folder).iterdir()) if path.is_file()}
    files[f"{info}/METADATA"] = (f"Metadata-Version: 2.1\nName: sunder\nVersion: {version}\nSummary: {SUMMARY}\n"
                                 "Requires-Python: >=3.11\nLicense-File: LICENSE\n").encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: sunder\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    files[f"{info}/LICENSE"] = pathlib.Path(licence).read_bytes()
    record = []
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record.append(f"{name},sha256={digest},{len(content)}\n")
    files[f"{info}/RECORD"] = ("".join(record) + f"{info}/RECORD,,\n").encode()
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name)
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)


main()
