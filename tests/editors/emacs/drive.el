;;; drive.el --- Ask eglot for what a user sees  -*- lexical-binding: t; -*-

;;; Commentary:
;; Run by a batch Emacs in the folder of the project: opens files and asks for what a user sees.
;; Expects the environment variable RESULT, the file to write one JSON object to.

;;; Code:

(require 'robocomp)
(require 'cl-lib)
(require 'json)

(defconst drive-deadline-s 60)
(defvar drive-seen nil "What was seen, by name.")

(setq eglot-sync-connect drive-deadline-s
      eglot-connect-timeout drive-deadline-s
      eglot-send-changes-idle-time 0
      eglot-confirm-server-initiated-edits nil
      eglot-autoshutdown nil
      create-lockfiles nil
      make-backup-files nil)

(defun drive-wait (what condition)
  "Let Emacs work until CONDITION gives something; WHAT says for what we wait."
  (let ((end (+ (float-time) drive-deadline-s)) found)
    (while (not (setq found (funcall condition)))
      (when (> (float-time) end)
        (error "Never happened: %s" what))
      (accept-process-output nil 0.05))
    found))

(defun drive-see (name value)
  "Note that VALUE was seen under NAME."
  (push (cons name value) drive-seen))

(defun drive-open (name)
  "Visit the file NAME as a user does; eglot manages it afterwards."
  (find-file name)
  (apply #'eglot--connect (eglot--guess-contact))
  (drive-wait name #'eglot-managed-p)
  (current-buffer))

(defun drive-finding (one)
  "Line and column from 0, and message, of the flymake diagnostic ONE."
  (save-excursion
    (goto-char (flymake-diagnostic-beg one))
    (list (1- (line-number-at-pos)) (current-column) (flymake-diagnostic-text one))))

(defun drive-findings (name)
  "What flymake shows in the file NAME, once it shows something."
  (find-file name)
  (unless (eglot-managed-p)
    (eglot--maybe-activate-editing-mode))
  (flymake-start)
  (mapcar #'drive-finding (drive-wait name #'flymake-diagnostics)))

(defun drive-at (text)
  "Put point behind the first TEXT of the buffer."
  (goto-char (point-min))
  (search-forward text))

(defun drive-hover ()
  "What eldoc is told of the interface that the component requires."
  (drive-at "requires L")
  (let (told)
    (eglot-hover-eldoc-function (lambda (text &rest _) (setq told (substring-no-properties text))))
    (drive-wait "hover" (lambda () told))))

(defun drive-completion ()
  "The names that are offered behind `requires'."
  (drive-at "requires ")
  (delete-region (point) (1- (search-forward ";")))
  (backward-char)
  (let* ((table (nth 2 (eglot-completion-at-point)))
         (offered (mapcar #'substring-no-properties (all-completions "" table))))
    (primitive-undo 1 buffer-undo-list)
    (revert-buffer t t t)
    offered))

(defun drive-definition ()
  "Where the name of the interface leads: file, line and column from 0."
  (drive-at "requires L")
  (xref-find-definitions "LSP identifier at point.")
  (list (file-name-nondirectory buffer-file-name)
        (1- (line-number-at-pos)) (current-column)))

(defun drive-text ()
  "The text of the buffer."
  (buffer-substring-no-properties (point-min) (point-max)))

(defun drive-rename ()
  "The texts after the interface got another name."
  (find-file "Laser.idsl")
  (drive-at "interface L")
  ;; Eglot asks before it changes files that no buffer visits.
  (cl-letf (((symbol-function 'y-or-n-p) #'always))
    (eglot-rename "Lidar"))
  (mapcar (lambda (name)
            (cons (intern name) (with-current-buffer (find-file-noselect name) (drive-text))))
          '("Laser.idsl" "reader.cdsl")))

(defun drive-format ()
  "The text after formatting, where the server offers that."
  (find-file "ugly.cdsl")
  (eglot-format-buffer)
  (drive-text))

(defun drive-faces ()
  "The faces of a keyword, a comment and a name."
  (find-file "reader.cdsl")
  (font-lock-ensure)
  (mapcar (lambda (text)
            (drive-at text)
            (get-text-property (1- (point)) 'face))
          '("Component" "Reads" "Component rea")))

(defun drive-indentation ()
  "Every line as a user gets it who indents the whole buffer."
  (find-file "reader.cdsl")
  (let ((text (drive-text)))
    (goto-char (point-min))
    (while (not (eobp))
      (delete-horizontal-space)
      (forward-line))
    (indent-region (point-min) (point-max))
    (prog1 (equal text (drive-text))
      (revert-buffer t t t))))

(defun drive ()
  "See everything."
  (drive-open "wrong.cdsl")
  (drive-see 'findings (mapcar (lambda (name) (cons (intern name) (vconcat (drive-findings name))))
                               '("wrong.cdsl" "wrong.idsl" "wrong.pdsl" "wrong.ddsl" "wrong.xml"
                                 "wrong.scxml")))
  (find-file "reader.cdsl")
  (eglot--maybe-activate-editing-mode)
  (drive-see 'hover (drive-hover))
  (drive-see 'completion (vconcat (drive-completion)))
  (drive-see 'definition (vconcat (drive-definition)))
  (drive-see 'faces (vconcat (mapcar #'symbol-name (drive-faces))))
  (drive-see 'indented (if (drive-indentation) t :json-false))
  (when (eglot--server-capable :documentFormattingProvider)
    (drive-see 'formatted (drive-format)))
  (drive-see 'renamed (drive-rename))
  (eglot-shutdown (eglot-current-server) nil drive-deadline-s))

(drive)
(with-temp-file (getenv "RESULT")
  (insert (json-encode drive-seen)))

;;; drive.el ends here
