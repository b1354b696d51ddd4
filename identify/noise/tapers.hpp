// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace catena {

/// Tapers for the spectra of segments of `length` frames (Slepian, D. (1978), Bell Syst. Tech. J. 57, 1371-1430):
/// orthonormal columns, each with as much as possible of its power within kTaperReach / length per frame of a
/// frequency. What they let leak beyond is less than a thousandth. Together they weigh most frames of a segment
/// alike (Thomson, D. J. (1982), Proc. IEEE 70, 1055-1096), where one taper alone would leave out both ends.
Eigen::MatrixXd slepian_tapers(int length);

}  // namespace catena
