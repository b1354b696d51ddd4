// SPDX-License-Identifier: BSD-3-Clause
// The derived equations stand in the page as LaTeX; here they become MathML.
import temml from 'temml';

export function typeset() {
  for (const host of document.querySelectorAll('.latex')) {
    temml.render(host.textContent, host, {displayMode: true, throwOnError: true});
  }
}
