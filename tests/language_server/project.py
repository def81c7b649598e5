"""A small project that the tests of features open: an interface, a component, a deployment."""

from __future__ import annotations

from tests.language_server.editor_client import Editor

SCANS = """/** What a laser sees. */
module Scans
{
    enum Mode { Slow, Fast };
    /** One beam. */
    struct Beam { float angle [rad]; float dist [mm]; Mode mode = Fast; };
    sequence<Beam> Scan;
    exception Broken { string why; };
    /** A planar laser. */
    interface Laser
    {
        /** All beams of one turn. */
        Scan scan() throws Broken;
        [command] void stop();
        void hint(int level);
    };
};
"""
READER = """import "Laser.idsl";
/** Reads. */
Component reader
{
    Communications { requires Laser; };
    language Python;
    parameters "reader.pdsl";
};
"""
BASE = """import "Laser.idsl";
/** Serves. */
Component base
{
    Communications { implements Laser; };
    language Python;
};
"""
PARAMETERS = """ComponentParams reader
{
    /** How often. */
    rate float 50 [Hz] 1:1000 live;
    pid { gain float 1; };
};
"""
APP = """import "reader.cdsl";
import "base.cdsl";
Deployment app
{
    component base;
    component eye : reader { after base; set rate = 20; set pid.gain = 2; };
    connect eye.Laser -> base.Laser;
};
"""
FILES = {
    "Laser.idsl": SCANS,
    "reader.cdsl": READER,
    "base.cdsl": BASE,
    "reader.pdsl": PARAMETERS,
    "app.ddsl": APP,
}


def write(editor: Editor) -> None:
    """Write the files."""
    for name, text in FILES.items():
        editor.write(name, text)


def marked(name: str, word: str, number: int = 1, into: int = 1) -> str:
    """The text of a file with a `|` some characters into the n-th `word`."""
    text = FILES[name]
    at = -1
    for _ in range(number):
        at = text.index(word, at + 1)
    return text[: at + into] + "|" + text[at + into :]
