// SPDX-License-Identifier: BSD-3-Clause
// The derived equations stand in the page as LaTeX; here they become MathML.
import temml from 'temml';

export function typeset() {
  for (const host of document.querySelectorAll('.latex')) {
    // Functions stand off what they multiply; MathML leaves that to us.
    const latex = host.textContent.replace(/(?<=[}\w]) (?=\\(sin|cos))/g, ' \\, ');
    try {
      host.innerHTML = temml.renderToString(latex, {displayMode: true, throwOnError: true});
    } catch (error) {  // it stays as LaTeX, and the others are typeset none the less
      if (!(error instanceof temml.ParseError)) throw error;
    }
  }
}
