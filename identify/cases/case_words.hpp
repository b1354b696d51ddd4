// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace catena {

/// The words of case files, in the order of the enumerations they stand for.
inline const std::vector<std::string> kScaleWords = {"linear", "log"};
inline const std::vector<std::string> kShapeWords = {"straight", "angles", "smooth", "catenary",
                                                     "hanging"};
inline const std::vector<std::string> kDataKindWords = {"markers", "angles"};
inline const std::vector<std::string> kUseWords = {"fit", "validate"};
inline const std::vector<std::string> kSourceWords = {"catena", "tracker", "kinovea", "deeplabcut"};
inline const std::vector<std::string> kOutlierWords = {"leave_out", "keep"};
inline const std::vector<std::string> kTimeUnits = {"s", "ms", "frames"};
inline const std::vector<std::string> kLengthUnits = {"m", "cm", "mm", "px"};
inline const std::vector<std::string> kAngleUnits = {"rad", "deg"};
inline const std::vector<std::string> kMeasureWords = {"least_squares", "mean_distance",
                                                       "mean_absolute", "likelihood"};
inline const std::vector<std::string> kNoiseWords = {"stated", "estimated"};
inline const std::vector<std::string> kLossWords = {"none", "huber", "soft_l1", "cauchy"};
inline const std::vector<std::string> kMethodWords = {"nelder_mead", "least_squares", "lbfgs",
                                                      "slsqp", "mma"};

}  // namespace catena
