/** Bodies are XML files, and an XML file may be anything: the root element tells. */

import * as vscode from "vscode";

const HEAD = 20_000;
const ROOT = /^\uFEFF?(?:\s|<\?[^]*?\?>|<!--[^]*?-->|<![A-Z][^>]*>)*<innerModel[\s/>]/;

/** Have every XML file that describes a body known as such, from now on. */
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
