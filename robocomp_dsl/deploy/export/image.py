"""The image of the containers: a Dockerfile with the locked packages and the components' files.

Pure. One image serves all components and the router; they share its layers.
"""

from __future__ import annotations

from robocomp_dsl.deploy.export.folder import ExportFile
from robocomp_dsl.deploy.export.model import CONTENT, STATE, ExportedDeployment
from robocomp_dsl.deploy.export.requirements import python_version

WHEELS = "wheels"
WHEELS_README = "Wheels in this folder are preferred to those of the package index.\n"


def image_name(exported: ExportedDeployment) -> str:
    """The name of the image without registry."""
    return f"robocomp-{exported.name}"


def image_files(exported: ExportedDeployment) -> dict[str, ExportFile]:
    """Dockerfile, requirements and the folder for wheels; the content is beside them."""
    dockerfile = f"""\
FROM python:{python_version()}-slim
COPY requirements.txt /opt/robocomp/
COPY {WHEELS}/ /opt/robocomp/{WHEELS}/
RUN pip install --no-cache-dir --no-deps --find-links /opt/robocomp/{WHEELS} \\
    -r /opt/robocomp/requirements.txt
COPY content/ {CONTENT}/
RUN useradd --uid 1000 --create-home robocomp && mkdir {STATE} && chown robocomp {STATE}
USER robocomp
ENV PYTHONUNBUFFERED=1
"""
    return {
        "Dockerfile": ExportFile(dockerfile),
        ".dockerignore": ExportFile("*\n!requirements.txt\n!wheels\n!content\n"),
        "requirements.txt": ExportFile(exported.requirements),
        f"{WHEELS}/README": ExportFile(WHEELS_README),
    }
