from robocomp_dsl.runtime import Monitor


class Near(Monitor):
    def __init__(self, limit: float) -> None:
        self.limit = limit

    def accept(self, operation, arguments):
        self.set_event("near", 0.5)
        return True


class Wrong(Monitor):
    def accept_pushLaser(self):
        return True

    def update(self, operation, arguments) -> None:
        pass

    def on_crate(self):
        pass
