// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/workshop.hpp"

#include <algorithm>

#include "common/sha256.hpp"

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

void Workshop::write_description_with(const std::vector<std::string>& effects, int links,
                                      const std::string& id, const fs::path& file) const {
  Description description = original_;
  for (const std::string& effect : effects) description.effects.push_back(find(effect)->effect);
  description.id = id;
  description.links = {links};
  write_description(description, file);
}

Model Workshop::model_with(const std::vector<std::string>& effects, int links) {
  std::string key = std::to_string(links);
  for (const std::string& effect : effects) key += " " + effect;
  std::promise<Model> promise;
  std::shared_future<Model> model;
  bool mine = false;
  {
    const std::lock_guard lock(mutex_);
    const auto [place, added] = models_.try_emplace(key);
    if (added) place->second = promise.get_future().share();
    model = place->second;
    mine = added;
  }
  if (mine) {
    try {
      std::string id = original_.id;
      for (const std::string& effect : effects) id += "_" + effect;
      if (effects.size() > 4)
        id = original_.id + "_and_" + std::to_string(effects.size()) + "_effects";
      const fs::path file = folder_ / (sha256_hex(key) + ".toml");
      write_description_with(effects, links, id, file);
      promise.set_value(provide_model(file, links, provider));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }
  return model.get();
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

void Workshop::say(const std::string& text) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  if (notice) notice(text);
}

}  // namespace catena
