#include "apps/cairn/fingerprint.hpp"

#include <filesystem>
#include <fstream>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 19;

std::string_view read_piece(std::ifstream& file, std::string& bytes) {
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return std::string_view(bytes).substr(0, static_cast<std::size_t>(file.gcount()));
}

}  // namespace

void Fingerprint::add(std::string_view text) {
  constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  constexpr std::uint64_t kEnd = 0xff;  // a byte that no UTF-8 text holds
  for (const char c : text) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * kPrime;
  hash_ = (hash_ ^ kEnd) * kPrime;
}

void Fingerprint::add_file(const std::string& path) {
  if (path.empty()) return;
  std::ifstream file(path, std::ios::binary);
  std::string bytes(kPiece, '\0');
  const std::uintmax_t size = std::filesystem::file_size(path);
  add(std::to_string(size));
  add(read_piece(file, bytes));
  if (size > 2 * kPiece) file.seekg(-static_cast<std::streamoff>(kPiece), std::ios::end);
  add(read_piece(file, bytes));
}

void Fingerprint::add_whole_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(kPiece, '\0');
  while (file) add(read_piece(file, bytes));
}

std::string Fingerprint::text() const { return fmt::format("{:016x}", hash_); }

}  // namespace cairn::app
