// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/vocabulary.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace scoria::logs {
namespace {

using Words = std::vector<std::string>;

/// Lower-case words: parts between separators, and where a capital follows a small letter.
Words SplitWords(std::string_view name) {
  Words words(1);
  char before = ' ';
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    const bool is_new =
        std::isupper(u) != 0 && std::islower(static_cast<unsigned char>(before)) != 0;
    if (std::isalnum(u) == 0 || is_new) words.emplace_back();
    if (std::isalnum(u) != 0) words.back() += static_cast<char>(std::tolower(u));
    before = c;
  }
  std::erase_if(words, [](const std::string& word) { return word.empty(); });
  return words;
}

struct LegWord {
  std::string_view word;
  Leg leg;
};
constexpr std::array kLegWords = {LegWord{"fl", Leg::kFL},         LegWord{"lf", Leg::kFL},
                                  LegWord{"frontleft", Leg::kFL},  LegWord{"leftfront", Leg::kFL},
                                  LegWord{"fr", Leg::kFR},         LegWord{"rf", Leg::kFR},
                                  LegWord{"frontright", Leg::kFR}, LegWord{"rightfront", Leg::kFR},
                                  LegWord{"hl", Leg::kHL},         LegWord{"lh", Leg::kHL},
                                  LegWord{"rl", Leg::kHL},         LegWord{"bl", Leg::kHL},
                                  LegWord{"lb", Leg::kHL},         LegWord{"hr", Leg::kHR},
                                  LegWord{"rh", Leg::kHR},         LegWord{"rr", Leg::kHR},
                                  LegWord{"br", Leg::kHR},         LegWord{"rb", Leg::kHR}};

std::optional<Leg> LegOfWord(std::string_view word) {
  for (const LegWord& known : kLegWords) {
    if (known.word == word) return known.leg;
  }
  for (const std::string_view end : {"hind", "rear", "back"}) {
    for (const bool left : {true, false}) {
      const std::string side = left ? "left" : "right";
      if (word == std::string(end) + side || word == side + std::string(end))
        return left ? Leg::kHL : Leg::kHR;
    }
  }
  return std::nullopt;
}

/// Takes the words that name a leg out of `words`, which the rest of the name is left in.
struct LegAndRest {
  std::optional<Leg> leg;
  Words rest;
};

LegAndRest FindLeg(Words words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::optional<Leg> leg = LegOfWord(words[i]);
    std::size_t used = 1;
    if (!leg && i + 1 < words.size()) {
      leg = LegOfWord(words[i] + words[i + 1]);
      used = 2;
    }
    if (!leg) continue;
    const auto first = words.begin() + static_cast<std::ptrdiff_t>(i);
    words.erase(first, first + static_cast<std::ptrdiff_t>(used));
    return {leg, std::move(words)};
  }
  return {std::nullopt, std::move(words)};
}

enum class JointWord { kNone, kHAA, kHFE, kKFE, kHip };

JointWord WordOf(const Words& words) {
  const auto has = [&](std::initializer_list<std::string_view> some) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
      return std::find(some.begin(), some.end(), word) != some.end();
    });
  };
  if (has({"haa", "abad", "abduction", "hx", "hipx", "adduction", "ab"})) return JointWord::kHAA;
  if (has({"kfe", "calf", "knee", "kn", "shank", "lower", "shin"})) return JointWord::kKFE;
  if (has({"hfe", "thigh", "shoulder", "hy", "hipy", "upper", "flexion"})) return JointWord::kHFE;
  if (!has({"hip"})) return JointWord::kNone;
  if (has({"x", "roll"})) return JointWord::kHAA;
  if (has({"y", "pitch"})) return JointWord::kHFE;
  return JointWord::kHip;
}

}  // namespace

std::optional<Leg> LegNamed(std::string_view name) {
  const LegAndRest found = FindLeg(SplitWords(name));
  return found.leg;
}

std::vector<std::optional<JointName>> JointsNamed(std::span<const std::string> names) {
  std::vector<LegAndRest> parts;
  std::vector<JointWord> words;
  for (const std::string& name : names) {
    parts.push_back(FindLeg(SplitWords(name)));
    words.push_back(parts.back().leg ? WordOf(parts.back().rest) : JointWord::kNone);
  }
  const bool has_haa = std::find(words.begin(), words.end(), JointWord::kHAA) != words.end();
  std::vector<std::optional<JointName>> joints;
  for (std::size_t i = 0; i < names.size(); ++i) {
    joints.emplace_back();
    if (words[i] == JointWord::kNone) continue;
    const bool is_hip = words[i] == JointWord::kHip;
    const Joint hip = has_haa ? Joint::kHFE : Joint::kHAA;
    const Joint other = words[i] == JointWord::kHAA   ? Joint::kHAA
                        : words[i] == JointWord::kHFE ? Joint::kHFE
                                                      : Joint::kKFE;
    joints.back() = JointName{*parts[i].leg, is_hip ? hip : other};
  }
  return joints;
}

}  // namespace scoria::logs
