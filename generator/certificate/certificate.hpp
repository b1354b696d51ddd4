// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate of an emitted model: a JSON file with what was derived, what was proved and how
// accurate the emitted code is. It has two parts.
//
//   exact      hashes of the description, of the Lagrangian and of every emitted file, operations
//              before and after sharing, proofs. The same, byte by byte, on every machine.
//   numerical  worst errors in units of rounding against 50 digits and against the closed forms,
//              power balance, natural frequencies; each with the tolerance it must keep.
//
// It contains no times, which differ from run to run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "description/description.hpp"
#include "generator/emission/emitted_files.hpp"

namespace catena {

/// "chain_12.certificate.json", for C99 "chain_12.c99.certificate.json".
std::string certificate_name(const std::string& model, Language language);

/// Derives the model, compiles and runs `files`, and returns the certificate. `files` are those of
/// emit_files in this language and at least for this number of links.
nlohmann::ordered_json make_certificate(const Description& description, int links,
                                        const EmittedFiles& files, Language language);

/// Failed proofs and exceeded tolerances; empty if there are none.
std::vector<std::string> failures(const nlohmann::ordered_json& certificate);

/// Differences between a certificate on file and one made now. Exact fields must be equal.
/// Numerical fields must have the same tolerances; their values may differ between machines.
std::vector<std::string> differences(const nlohmann::ordered_json& on_file,
                                     const nlohmann::ordered_json& now);

}  // namespace catena
