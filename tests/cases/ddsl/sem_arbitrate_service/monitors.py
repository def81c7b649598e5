from robocomp_dsl.runtime import Monitor


class Seldom(Monitor):
    def accept(self, operation, arguments):
        self.set_event("urgent", 1.0)
        return True
