#pragma once

#include <string>
#include <vector>

namespace cairn {

/// What to do about a key (or a choice) that is not known: the nearest of `known`, by insertions, deletions
/// and replacements; else an option of that name elsewhere, from its dotted `paths`; else all of `known`.
std::string suggest(const std::string& key, const std::vector<std::string>& known,
                    const std::vector<std::string>& paths = {});

/// `text` fit for a message: what is not printable ASCII as \xNN, at most its first 60 characters.
std::string printable(const std::string& text);
/// The same between quotes.
std::string quoted(const std::string& text);

}  // namespace cairn
