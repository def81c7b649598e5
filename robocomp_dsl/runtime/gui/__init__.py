"""Components with a window: `gui Qt(QWidget);` in the CDSL file.

Qt runs in the main thread, with the hooks of the component; handlers run in the threads of the
middlewares. One callback group excludes them from each other, and from the slots of the window.
Nothing here is loaded by a component without a window.
"""
