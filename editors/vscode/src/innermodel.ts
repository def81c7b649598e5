/** Detects InnerModel among XML files by the root element. */

import * as vscode from "vscode";

const HEAD = 20_000;
const ROOT = /^\uFEFF?(?:\s|<\?[^]*?\?>|<!--[^]*?-->|<![A-Z][^>]*>)*<innerModel[\s/>]/;

/** Set the language of every InnerModel file, now and when it is opened. */
export function recognize(): vscode.Disposable {
  vscode.workspace.textDocuments.forEach(look);
  return vscode.workspace.onDidOpenTextDocument(look);
}

function look(document: vscode.TextDocument): void {
  if (document.languageId !== "xml") {
    return;
  }
  const head = document.getText(new vscode.Range(new vscode.Position(0, 0), document.positionAt(HEAD)));
  if (ROOT.test(head)) {
    void vscode.languages.setTextDocumentLanguage(document, "innermodel");
  }
}
