// SPDX-License-Identifier: BSD-3-Clause
// Canvases are drawn at twice the size of the screen's pixels at least, so that prints are sharp.
export const renderingPixelRatio = Math.max(2, window['devicePixelRatio'] || 1);
