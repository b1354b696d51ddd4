// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "identify/diagnosis/diagnosis_text.hpp"

namespace catena {

/// A new folder for temporary files, gone with the object. Throws std::runtime_error if it cannot
/// be made.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A folder beside `folder` in which a result is put together: what stands in `folder` is replaced
/// at once when all of it is there, and an interrupted run leaves nothing. Throws InputError if it
/// cannot be made.
class UnfinishedFolder {
 public:
  explicit UnfinishedFolder(const std::filesystem::path& folder);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  void publish();

 private:
  std::filesystem::path folder_, path_;
};

/// Writes a diagnosis into a folder, which is made: model.toml and the emitted code in model/ where
/// an effect was found, diagnosed.toml, the results of the rounds and, last, diagnosis.json, whose
/// text is returned. Throws InputError where a file cannot be written, ModelError where the model
/// cannot be derived.
std::string write_diagnosis(const Diagnosis& found, const DiagnosisFindings& findings,
                            const DiagnosisContext& context, const std::filesystem::path& folder);

}  // namespace catena
