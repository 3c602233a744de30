#pragma once

#include "cairn/core/pose2.hpp"

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace cairn {

/// What a wall is made of: decides which sensors see it.
enum class Material : std::uint8_t { kOpaque = 0, kGlass = 1, kMesh = 2, kMirror = 3 };

/// "opaque", "glass", "mesh", "mirror".
std::string_view name_of(Material material);
/// The material of that name. @throws InputError naming the known ones
Material material_named(std::string_view name);

/// A set of materials.
class MaterialSet {
 public:
  constexpr MaterialSet(std::initializer_list<Material> materials) {
    for (const Material m : materials) bits_ = static_cast<std::uint8_t>(bits_ | bit(m));
  }
  constexpr bool contains(Material m) const { return (bits_ & bit(m)) != 0; }
  friend bool operator==(const MaterialSet&, const MaterialSet&) = default;

 private:
  static constexpr std::uint8_t bit(Material m) {
    return static_cast<std::uint8_t>(1u << static_cast<unsigned>(m));
  }
  std::uint8_t bits_ = 0;
};

inline constexpr MaterialSet kAllMaterials{Material::kOpaque, Material::kGlass, Material::kMesh,
                                           Material::kMirror};
/// What returns a laser beam from where it stands: glass lets it through, a mirror shows another place.
inline constexpr MaterialSet kSeenByLaser{Material::kOpaque, Material::kMesh};

/// Straight piece of a wall, seen from both sides; metres, map frame.
struct Wall {
  Point2 a;
  Point2 b;
  Material material = Material::kOpaque;
  friend bool operator==(const Wall&, const Wall&) = default;
};

/// Rectangle along the axes, metres.
struct Bounds2 {
  Point2 min;
  Point2 max;
};

/// Immutable map of straight wall segments. They may touch, cross and overlap.
class VectorMap {
 public:
  static constexpr std::size_t kMaxWalls = 5'000'000;
  static constexpr double kMaxCoordinate_m = 1e7;

  /// @throws InputError for no wall or more than kMaxWalls, and for a wall without length or with a
  ///   coordinate that is not finite or beyond kMaxCoordinate_m (it says which)
  explicit VectorMap(std::vector<Wall> walls);

  const std::vector<Wall>& walls() const { return walls_; }
  const Bounds2& bounds() const { return bounds_; }
  double length_m() const { return length_m_; }  ///< of all walls
  std::size_t count(Material material) const;

 private:
  std::vector<Wall> walls_;
  Bounds2 bounds_;
  double length_m_ = 0.0;
};

/// Distance from the point to the nearest point of the wall, metres.
double distance(const Point2& point, const Wall& wall);

}  // namespace cairn
