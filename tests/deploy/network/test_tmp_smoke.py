import time
from tests.deploy.network.conftest import *
def test_smoke(site, monkeypatch):
    with site.routers() as routers:
        with site.start("worker", monkeypatch) as w:
            w.until("running every")
            with site.start("boss", monkeypatch) as b:
                try:
                    b.until("calls the worker","reliable news","latched state")
                    w.until("starts to dig")
                finally:
                    b.process.terminate(); b.end(); w.process.terminate(); w.end()
                    print("\n".join(b.lines)); print("\n".join(w.lines))
                    for r in routers: r.process.terminate(); r.end(); print("\n".join(r.lines))
