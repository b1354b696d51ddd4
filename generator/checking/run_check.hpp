// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace catena {

/// `catena check DERIVATION`: argv[0] is the name to print in messages, the arguments follow. Returns
/// the exit status: 0 if every entry is proved equal, 1 if one is different or undecided, 2 for wrong
/// usage or a derivation that cannot be read.
int run_check(int argc, char** argv);

}  // namespace catena
