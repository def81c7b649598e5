"""The LALR engine: tables, lexer, token stream, parser. It knows no language."""
