// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate of an emitted model: a small JSON that says what was derived, what was proved of
// it and how exactly the emitted code computes. It has two parts.
//
//   exact      hashes of the description, of the Lagrangian and of every emitted file, operations
//              before and after sharing, proofs. The same, byte by byte, on every machine.
//   numerical  worst errors in units of rounding against 50 digits and against the closed forms,
//              power balance, natural frequencies; each with the tolerance it must keep.
//
// Times are not in it: they differ from run to run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "description/description.hpp"
#include "generator/emission/emitted_files.hpp"

namespace catena {

/// "chain_12.certificate.json", of C99 "chain_12.c99.certificate.json"
std::string certificate_name(const std::string& model, Language language);

/// Derives the model, compiles `files` (as emit_files gives them in this language, for this link
/// count at least), runs it, and writes down what it found.
nlohmann::ordered_json make_certificate(const Description& description, int links,
                                        const EmittedFiles& files, Language language);

/// What speaks against the model: proofs that failed, tolerances not kept. Empty: nothing.
std::vector<std::string> failures(const nlohmann::ordered_json& certificate);

/// What differs between a certificate on file and one made now: exact fields must be equal;
/// numerical ones must have the same tolerances (their values may differ between machines).
std::vector<std::string> differences(const nlohmann::ordered_json& on_file,
                                     const nlohmann::ordered_json& now);

}  // namespace catena
