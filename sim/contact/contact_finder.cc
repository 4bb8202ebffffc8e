// SPDX-License-Identifier: BSD-3-Clause
#include "sim/contact/contact_finder.h"

#include <algorithm>
#include <utility>

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <btBulletCollisionCommon.h>

#include "core/demand.h"
#include "sim/bullet_vectors.h"
#include "sim/contact/ground_contact.h"

static_assert(sizeof(btScalar) == 8, "scoria needs Bullet in double precision (bullet-float64)");

namespace scoria::sim {
namespace {

using core::kNumBodies;
using core::RobotDescription;
using core::Shape;

/// Bullet finds contacts of convex shapes fastest and most surely within a margin around them. As
/// of its boxes, the margin lies inside: the points move inwards, so that faces stay where they are
/// and only corners are rounded.
std::unique_ptr<btCollisionShape> MakeHull(const Shape& shape) {
  constexpr double kMargin_m = 1e-3, kShare = 0.1;  // at most this of the thinnest half extent
  const double margin_m = std::min(kMargin_m, kShare * 0.5 * shape.size_m.minCoeff());
  const Vec3 shrink = Vec3::Ones() - (2.0 * margin_m * shape.size_m.cwiseInverse());
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& p : shape.hull) hull->addPoint(ToBullet(shrink.cwiseProduct(p)), false);
  hull->setMargin(margin_m);
  hull->recalcLocalAabb();
  return hull;
}

std::unique_ptr<btCollisionShape> MakeShape(const Shape& shape) {
  const Vec3& s = shape.size_m;
  switch (shape.kind) {
    case Shape::Kind::kBox:
      return std::make_unique<btBoxShape>(ToBullet(0.5 * s));
    case Shape::Kind::kCylinder:  // as a capsule of the same length: no edges to catch on triangles
      return std::make_unique<btCapsuleShapeZ>(s.x(), std::max(0.0, s.y() - 2.0 * s.x()));
    case Shape::Kind::kSphere:
      return std::make_unique<btSphereShape>(s.x());
    case Shape::Kind::kHull:
      return MakeHull(shape);
    case Shape::Kind::kMesh:
      break;
  }
  SCORIA_DEMAND(false, "a mesh does not collide; MakeRobot puts its hull in its place");
}

/// A heightfield whose bounds exclude nothing: Bullet drops the algorithm, and with it the order,
/// of a shape beyond them. How near a shape is the algorithms of GroundContact see themselves.
class BoundlessHeightfield final : public btHeightfieldTerrainShape {
 public:
  using btHeightfieldTerrainShape::btHeightfieldTerrainShape;
  void getAabb(const btTransform&, btVector3& low, btVector3& high) const override {
    constexpr double kFar_m = 1e9;
    low.setValue(-kFar_m, -kFar_m, -kFar_m);
    high.setValue(kFar_m, kFar_m, kFar_m);
  }
};

btCollisionObjectWrapper Wrap(const btCollisionObject& object) {
  return {nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1};
}

/// Memory for what lives as long as a finder, and for what meets one triangle. Bullet's own default
/// holds thousands, 7 MB.
btDefaultCollisionConstructionInfo Pools(const RobotDescription& robot) {
  constexpr int kSpare = 8;
  const int shapes = static_cast<int>(robot.collisions.size());
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = shapes + kSpare;
  info.m_defaultMaxCollisionAlgorithmPoolSize = shapes + kNumBodies + kSpare;
  return info;
}

}  // namespace

struct ContactFinder::Impl {
  Impl(const RobotDescription& robot_in, const terrains::Heightfield& ground_in,
       std::shared_ptr<const GroundShape> shape)
      : robot(robot_in),
        ground(ground_in),
        configuration(Pools(robot_in)),
        ground_contact(dispatcher, std::move(shape)) {
    AddGround();
    for (int body = kNumBodies - 1; body >= 0; --body) AddBody(body);
  }
  Impl(const Impl& other) : Impl(other.robot, other.ground, other.ground_contact.shape()) {
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      const btPersistentManifold& from = other.ManifoldOf(s);
      btPersistentManifold& to = ManifoldOf(s);
      to.setNumContacts(from.getNumContacts());
      for (int i = 0; i < from.getNumContacts(); ++i)
        to.getContactPoint(i) = from.getContactPoint(i);
      shapes[s].is_listed = other.shapes[s].is_listed;
    }
    listed = other.listed;
  }
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    for (const Body& body : bodies) {
      body.algorithm->~btCollisionAlgorithm();
      dispatcher.freeCollisionAlgorithm(body.algorithm);
    }
  }

  /// A collision shape fixed to a body.
  struct BodyShape {
    std::unique_ptr<btCollisionShape> shape;
    btTransform X_LG;
    int body = 0;  // as core::BodyIndex
    bool is_foot = false;
    bool is_near = false;    // the ground's slab, at the last poses
    bool is_listed = false;  // in `listed`
  };
  /// A body that collides, its shapes, and its algorithm against the ground.
  struct Body {
    int index = 0;
    std::unique_ptr<btCompoundShape> compound;
    std::unique_ptr<btCollisionObject> object;
    btCollisionAlgorithm* algorithm = nullptr;  // lives in the dispatcher's pool
    std::size_t first_shape = 0, end_shape = 0;
  };

  void AddGround();
  void AddBody(int index);
  [[nodiscard]] bool IsNear(const Body& body, const BodyShape& shape) const;
  void UpdateList(const Body& body);
  // Every shape has one manifold, made in the order of the shapes.
  [[nodiscard]] btPersistentManifold& ManifoldOf(std::size_t shape) {
    return *dispatcher.getManifoldByIndexInternal(static_cast<int>(shape));
  }
  [[nodiscard]] const btPersistentManifold& ManifoldOf(std::size_t shape) const {
    return *dispatcher.getManifoldByIndexInternal(static_cast<int>(shape));
  }

  const RobotDescription& robot;
  const terrains::Heightfield& ground;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  GroundContact ground_contact;
  std::unique_ptr<BoundlessHeightfield> ground_shape;
  btCollisionObject ground_object;
  double slab_low_m = 0.0, slab_high_m = 0.0;
  std::vector<BodyShape> shapes;
  std::vector<Body> bodies;
  std::vector<std::size_t> listed;  // shapes near the slab, as their contacts are given out
};

void ContactFinder::Impl::AddGround() {
  constexpr double kMargin_m = 0.01;
  constexpr double kDeep_m = 1.0, kOvershoot_m = 0.1;  // feet sink; the surface is bicubic
  constexpr int kUpAxis = 2;
  const double low = ground.min_m() - kMargin_m, high = ground.max_m() + kMargin_m;
  ground_shape = std::make_unique<BoundlessHeightfield>(
      ground.nodes(), ground.nodes(), ground.heights_m().data(), low, high, kUpAxis, false);
  ground_shape->setLocalScaling(btVector3(ground.resolution_m(), ground.resolution_m(), 1.0));
  ground_object.setCollisionShape(ground_shape.get());
  ground_object.setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
  // Bullet centres the shape between the two heights.
  ground_object.setWorldTransform(ToBullet(Mat3::Identity(), {0.0, 0.0, 0.5 * (low + high)}));
  btVector3 lowest, highest;
  ground_shape->btHeightfieldTerrainShape::getAabb(ground_object.getWorldTransform(), lowest,
                                                   highest);
  slab_low_m = lowest.z() - kDeep_m;
  slab_high_m = highest.z() + kOvershoot_m;
}

void ContactFinder::Impl::AddBody(int index) {
  Body body;
  body.index = index;
  body.compound = std::make_unique<btCompoundShape>(false);
  body.object = std::make_unique<btCollisionObject>();
  body.object->setCollisionShape(body.compound.get());
  body.first_shape = shapes.size();
  for (const Shape& shape : robot.collisions) {
    if (shape.body != index) continue;
    shapes.push_back({MakeShape(shape), ToBullet(shape.R_LG, shape.p_LG), index, shape.is_foot});
    body.compound->addChildShape(shapes.back().X_LG, shapes.back().shape.get());
  }
  body.end_shape = shapes.size();
  if (body.end_shape == body.first_shape) return;
  const btCollisionObjectWrapper ground_wrap = Wrap(ground_object), body_wrap = Wrap(*body.object);
  body.algorithm =
      dispatcher.findAlgorithm(&ground_wrap, &body_wrap, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  bodies.push_back(std::move(body));
  SCORIA_DEMAND(static_cast<std::size_t>(dispatcher.getNumManifolds()) == shapes.size(),
                "{} manifolds of {} shapes", dispatcher.getNumManifolds(), shapes.size());
}

/// Its box reaches into the slab between the lowest and the highest ground.
bool ContactFinder::Impl::IsNear(const Body& body, const BodyShape& shape) const {
  btVector3 low, high;
  shape.shape->getAabb(body.object->getWorldTransform() * shape.X_LG, low, high);
  return low.z() <= slab_high_m && high.z() >= slab_low_m;
}

/// A shape that comes near goes to the end of the list, and the last one takes the place of one
/// that leaves, as Bullet's dispatcher keeps its manifolds. The step solver goes through contacts
/// one by one, so that its last bits depend on their order.
void ContactFinder::Impl::UpdateList(const Body& body) {
  for (std::size_t s = body.first_shape; s < body.end_shape; ++s) {
    shapes[s].is_near = IsNear(body, shapes[s]);
    if (!shapes[s].is_near || shapes[s].is_listed) continue;
    shapes[s].is_listed = true;
    listed.push_back(s);
  }
  for (std::size_t s = body.first_shape; s < body.end_shape; ++s) {
    if (shapes[s].is_near || !shapes[s].is_listed) continue;
    shapes[s].is_listed = false;
    *std::find(listed.begin(), listed.end(), s) = listed.back();
    listed.pop_back();
  }
}

ContactFinder::ContactFinder(const RobotDescription& robot, const terrains::Heightfield& ground)
    : impl_(std::make_unique<Impl>(robot, ground, MakeGroundShape(ground))) {}

ContactFinder::~ContactFinder() = default;

ContactFinder::ContactFinder(const ContactFinder& other)
    : impl_(std::make_unique<Impl>(*other.impl_)) {}

void ContactFinder::Find(const std::array<core::LinkPose, kNumBodies>& poses, const Vec3& p_WB,
                         std::vector<ContactPoint>& contacts) {
  Impl& f = *impl_;
  const btCollisionObjectWrapper ground_wrap = Wrap(f.ground_object);
  const btDispatcherInfo info;
  for (const Impl::Body& body : f.bodies) {
    const auto& [R_WL, p_WL] = poses[static_cast<std::size_t>(body.index)];
    body.object->setWorldTransform(ToBullet(R_WL, p_WL));
    const btCollisionObjectWrapper body_wrap = Wrap(*body.object);
    btManifoldResult result(&ground_wrap, &body_wrap);
    body.algorithm->processCollision(&ground_wrap, &body_wrap, info, &result);
    f.UpdateList(body);
  }
  contacts.clear();
  for (const std::size_t s : f.listed) {
    const btPersistentManifold& manifold = f.ManifoldOf(s);
    const bool ground_first = manifold.getBody0() == &f.ground_object;
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& point = manifold.getContactPoint(i);
      ContactPoint contact;
      contact.body = f.shapes[s].body;
      contact.is_foot = f.shapes[s].is_foot;
      contact.n_W = (ground_first ? -1.0 : 1.0) * ToVec3(point.m_normalWorldOnB);
      contact.p_BP_W =
          ToVec3(ground_first ? point.getPositionWorldOnB() : point.getPositionWorldOnA()) - p_WB;
      contact.gap_m = point.getDistance();
      contacts.push_back(contact);
    }
  }
}

void ContactFinder::Forget() {
  for (std::size_t s = 0; s < impl_->shapes.size(); ++s) impl_->ManifoldOf(s).clearManifold();
}

}  // namespace scoria::sim
