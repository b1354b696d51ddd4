// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/workshop.hpp"

#include <algorithm>

namespace catena {

namespace fs = std::filesystem;

Workshop::Workshop(const fs::path& description, const std::vector<fs::path>& effect_files,
                   fs::path folder, LeastSquares solver, ProviderOptions provider_options)
    : least_squares(std::move(solver)),
      provider(std::move(provider_options)),
      original_(description.empty() ? plain_chain() : read_description(description)),
      folder_(std::move(folder)),
      library_(library_of_candidates(effect_files, original_)) {}

const Candidate* Workshop::find(const std::string& id) const {
  const auto found = std::find_if(library_.begin(), library_.end(),
                                  [&](const Candidate& candidate) { return candidate.id == id; });
  return found == library_.end() ? nullptr : &*found;
}

fs::path Workshop::description_with(const std::vector<std::string>& effects, int links) {
  Description description = original_;
  std::string name = original_.id;
  for (const std::string& id : effects) {
    description.effects.push_back(find(id)->effect);
    name += "_with_" + id;
  }
  if (effects.size() > 4)
    name = original_.id + "_with_" + std::to_string(effects.size()) + "_effects";
  description.id = name;
  description.links = {links};
  const fs::path file = folder_ / (name + "_" + std::to_string(links) + ".toml");
  write_description(description, file);
  return file;
}

Model Workshop::model_with(const std::vector<std::string>& effects, int links) {
  const std::lock_guard lock(mutex_);
  const fs::path file = description_with(effects, links);
  const auto known = models_.find(file.string());
  if (known != models_.end()) return known->second;
  return models_.emplace(file.string(), provide_model(file, links, provider)).first->second;
}

Model Workshop::model_with_all(int links, const std::vector<std::string>& needed) {
  std::vector<std::string> effects;
  for (const Candidate& candidate : library_) {
    const bool wanted = std::find(needed.begin(), needed.end(), candidate.id) != needed.end();
    if (wanted || (candidate.unavailable.empty() && !candidate.own_model))
      effects.push_back(candidate.id);
  }
  return model_with(effects, links);
}

void Workshop::say(const std::string& text) const {
  if (notice) notice(text);
}

}  // namespace catena
