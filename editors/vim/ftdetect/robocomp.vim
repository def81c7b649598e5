" RoboComp's languages have suffixes of their own; InnerModel is XML and stays it.
autocmd BufNewFile,BufRead *.idsl setfiletype idsl
autocmd BufNewFile,BufRead *.cdsl setfiletype cdsl
autocmd BufNewFile,BufRead *.pdsl setfiletype pdsl
autocmd BufNewFile,BufRead *.ddsl setfiletype ddsl
autocmd BufNewFile,BufRead *.smdsl setfiletype smdsl
autocmd BufNewFile,BufRead *.bdsl setfiletype bdsl
