class Near(Monitor):
    def accept(self
