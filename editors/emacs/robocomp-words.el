;;; robocomp-words.el --- Words of RoboComp's languages  -*- lexical-binding: t; -*-
;;; Code:
(defconst robocomp-words
  '((idsl nil "module" "interface")
    (cdsl t "component")
    (pdsl nil "int")
    (ddsl nil "component")
    (smdsl nil "states"))
  "For each language: whether the case of letters plays no part, and its words.")
(provide 'robocomp-words)
;;; robocomp-words.el ends here
