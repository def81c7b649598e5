;;; robocomp.el --- RoboComp's description languages  -*- lexical-binding: t; -*-

;; Version: 0.1.0
;; Package-Requires: ((emacs "27.1") (eglot "1.9"))
;; Keywords: languages, robotics

;;; Commentary:

;; Modes for IDSL, CDSL, PDSL, DDSL, SMDSL, BDSL, SCXML and InnerModel files, and their language server
;; for eglot.  In your init file:
;;
;;   (add-to-list 'load-path "/path/to/editors/emacs")
;;   (require 'robocomp)
;;   (add-hook 'robocomp-mode-hook #'eglot-ensure)
;;   (add-hook 'robocomp-innermodel-mode-hook #'eglot-ensure)
;;   (add-hook 'robocomp-scxml-mode-hook #'eglot-ensure)

;;; Code:

(require 'eglot)
(require 'nxml-mode)
(require 'robocomp-words)
(require 'seq)

(defgroup robocomp nil
  "Descriptions of robot components."
  :group 'languages)

(defcustom robocomp-server nil
  "The program `rcgen'; nil: search the project's .venv, then the PATH."
  :type '(choice (const :tag "Find it" nil) file))

(defconst robocomp--missing
  (concat "RoboComp: `rcgen' was not found, neither in a .venv above this file nor on the PATH; "
          "install it with  pip install 'robocomp_dsl[editor]'  or customize `robocomp-server'"))

(defun robocomp-find-server ()
  "The program `rcgen' for the current buffer, or nil."
  (let ((home (locate-dominating-file default-directory ".venv")))
    (or robocomp-server
        (and home
             (seq-find #'file-executable-p
                       (list (expand-file-name ".venv/bin/rcgen" home)
                             (expand-file-name ".venv/Scripts/rcgen.exe" home))))
        (executable-find "rcgen"))))

(defun robocomp--contact (&optional _interactive)
  "The command of the language server, for eglot."
  (list (or (robocomp-find-server) (user-error "%s" robocomp--missing)) "lsp"))

(defvar robocomp-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?/ ". 124b" table)
    (modify-syntax-entry ?* ". 23" table)
    (modify-syntax-entry ?\n "> b" table)
    (modify-syntax-entry ?\" "\"" table)
    (modify-syntax-entry ?_ "w" table)
    table)
  "Syntax of all languages with braces.")

(defun robocomp--indent-line ()
  "Indent the line by four columns for each brace around it."
  (interactive)
  (let* ((closes (save-excursion (back-to-indentation) (looking-at-p "[]})]")))
         (depth (car (syntax-ppss (line-beginning-position))))
         (column (* 4 (max 0 (if closes (1- depth) depth)))))
    (if (<= (current-column) (current-indentation))
        (indent-line-to column)
      (save-excursion (indent-line-to column)))))

;;;###autoload
(define-derived-mode robocomp-mode prog-mode "RoboComp"
  "Parent mode of all languages with braces."
  (setq-local comment-start "// "
              comment-end ""
              comment-start-skip "\\(?://+\\|/\\*+\\)[ \t]*"
              indent-tabs-mode nil
              indent-line-function #'robocomp--indent-line
              electric-indent-chars (cons ?} electric-indent-chars)))

(defun robocomp--fontify (language)
  "Highlight the keywords of LANGUAGE."
  (let ((words (alist-get language robocomp-words)))
    (setq-local font-lock-defaults
                (list (list (cons (regexp-opt (cdr words) 'words) 'font-lock-keyword-face))
                      nil (car words)))))

;;;###autoload
(define-derived-mode robocomp-idsl-mode robocomp-mode "IDSL"
  "Interfaces of components."
  (robocomp--fontify 'idsl))

;;;###autoload
(define-derived-mode robocomp-cdsl-mode robocomp-mode "CDSL"
  "Components."
  (robocomp--fontify 'cdsl))

;;;###autoload
(define-derived-mode robocomp-pdsl-mode robocomp-mode "PDSL"
  "Parameters of components."
  (robocomp--fontify 'pdsl))

;;;###autoload
(define-derived-mode robocomp-ddsl-mode robocomp-mode "DDSL"
  "Deployments of components."
  (robocomp--fontify 'ddsl))

;;;###autoload
(define-derived-mode robocomp-smdsl-mode robocomp-mode "SMDSL"
  "State machines of components."
  (robocomp--fontify 'smdsl))

;;;###autoload
(define-derived-mode robocomp-bdsl-mode robocomp-mode "BDSL"
  "Bridges between middlewares."
  (robocomp--fontify 'bdsl))

;;;###autoload
(define-derived-mode robocomp-innermodel-mode nxml-mode "InnerModel"
  "Bodies of robots.")

;;;###autoload
(define-derived-mode robocomp-scxml-mode nxml-mode "SCXML"
  "State machines in the format of the W3C.")

;;;###autoload
(progn
  (add-to-list 'auto-mode-alist '("\\.idsl\\'" . robocomp-idsl-mode))
  (add-to-list 'auto-mode-alist '("\\.cdsl\\'" . robocomp-cdsl-mode))
  (add-to-list 'auto-mode-alist '("\\.pdsl\\'" . robocomp-pdsl-mode))
  (add-to-list 'auto-mode-alist '("\\.ddsl\\'" . robocomp-ddsl-mode))
  (add-to-list 'auto-mode-alist '("\\.smdsl\\'" . robocomp-smdsl-mode))
  (add-to-list 'auto-mode-alist '("\\.bdsl\\'" . robocomp-bdsl-mode))
  (add-to-list 'auto-mode-alist '("\\.scxml\\'" . robocomp-scxml-mode))
  ;; XML files are InnerModel if their root element is `innerModel'.
  (add-to-list 'magic-mode-alist
               '("\\(?:<\\?xml[^>]*>\\|<!--[^>]*-->\\|[ \t\r\n]\\)*<innerModel[ \t\r\n/>]"
                 . robocomp-innermodel-mode)))

(dolist (language '("idsl" "cdsl" "pdsl" "ddsl" "smdsl" "bdsl" "innermodel" "scxml"))
  (put (intern (format "robocomp-%s-mode" language)) 'eglot-language-id language))

(add-to-list 'eglot-server-programs
             '((robocomp-idsl-mode robocomp-cdsl-mode robocomp-pdsl-mode robocomp-ddsl-mode
                robocomp-smdsl-mode robocomp-bdsl-mode robocomp-innermodel-mode
                robocomp-scxml-mode)
               . robocomp--contact))

(provide 'robocomp)
;;; robocomp.el ends here
