// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <utility>
#include <variant>

#include "core/config/archive.h"
#include "core/math/types.h"
#include "sim/plant/contact_point.h"
#include "terrains/heightfield.h"

namespace scoria::sim {

/// Ground that springs back, and holds a foot up to the friction limit.
struct ElasticGround {
  static constexpr const char* kType = "elastic";
  template <class Archive>
  void Serialize(Archive&) {}
};

/// Ground that keeps the imprint of a foot and has to be sheared before it holds. Unloading is
/// stiffer than loading by `unloading_ratio`, down and along the ground alike; the share of the
/// friction limit that shear displacement j mobilises is 1 − exp(−j / K). Source: [Janosi1961];
/// unloading 5 to 10 times stiffer as for dry granular soil.
struct PlasticGround {
  static constexpr const char* kType = "plastic";
  double unloading_ratio = 7.0;
  double shear_displacement_m = 0.010;  // K
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("unloading_ratio", unloading_ratio,
            {.min = 1.0, .max = 100.0, .doc = "stiffness of unloading over that of loading"});
    a.Field("shear_displacement_m", shear_displacement_m,
            {.min = 0.002, .max = 0.1, .doc = "Janosi's K"});
  }
};

using GroundParams = std::variant<ElasticGround, PlasticGround>;

/// Force of a sphere that has sunk by z into a layer on a substrate:
///   F = k_l A(z) z + (k_s − k_l) A(z − d) (z − d),   A(z) = π (2 R z − z²) up to z = R, then π R²,
/// the second term only below the layer's depth d. 0 for z <= 0.
[[nodiscard]] double CalcSinkageForce(const terrains::GroundSample& ground, double radius_m,
                                      double sinkage_m) noexcept;

/// The ground under one foot, from touchdown to touchdown.
class FootGround {
 public:
  FootGround() = default;
  FootGround(const GroundParams& params, double radius_m, double load_kg) noexcept;

  /// Fills friction, springs and dampers of a contact that approaches at `approach_mps`. Stiffness
  /// is the secant of the pressure-sinkage law where the foot is about to be, so that the implicit
  /// step stays stable on any ground and rests exactly on the law. A foot that has left its
  /// imprint, stepping or sliding, meets fresh ground.
  /// @param p_WP  the contact point.
  void Prepare(const terrains::GroundSample& ground, const Vec3& p_WP, double approach_mps,
               double dt_s, ContactPoint& contact) noexcept;

  /// Remembers what the solved contact did to the ground.
  /// @param p_WP  the contact point.
  void Finish(const ContactPoint& contact, const Vec3& p_WP, double dt_s) noexcept;

  /// The foot is in the air.
  void Lift() noexcept;

 private:
  void Shear(const Vec3& slip_W, const Vec3& n_W) noexcept;

  PlasticGround law_{1.0, 0.0};  // elastic ground is plastic ground with no memory
  bool remembers_ = false;
  double radius_m_ = 0.0, load_kg_ = 0.0;
  double deepest_m_ = 0.0;       // of the imprint
  Vec3 p_WI_ = Vec3::Zero();     // place of the imprint
  Vec3 shear_W_ = Vec3::Zero();  // displacement since the foot took hold
  double normal_N_ = 0.0;        // of the last step
};

/// Fills a contact of a body other than a foot: a blunt corner on the same ground.
void PrepareBodyContact(const terrains::GroundSample& ground, double load_kg,
                        ContactPoint& contact) noexcept;

}  // namespace scoria::sim
