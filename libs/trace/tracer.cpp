#include "trace/tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.h"
#include "trace/surface_resolver.h"

namespace vsgl::trace {
namespace {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct GeometryRelease {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename Handle, typename Release>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

// Throws what the device's last call went wrong with.
void require_success(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    throw Error(ErrorCode::memory, "not enough memory to trace rays through the scene; use a smaller scene");
  throw Error(ErrorCode::internal, "Embree failed with error " + std::to_string(error));
}

RTCRay make_ray(Vec3 origin, Vec3 direction, float nearest, float farthest) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x);
  ray.org_y = static_cast<float>(origin.y);
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = nearest;
  ray.tfar = farthest;
  ray.mask = ~0U;
  return ray;
}

constexpr std::size_t kPacket = PointPacket::kLanes;

void put(RTCRay16& rays, std::size_t i, const RTCRay& ray) {
  rays.org_x[i] = ray.org_x;
  rays.org_y[i] = ray.org_y;
  rays.org_z[i] = ray.org_z;
  rays.dir_x[i] = ray.dir_x;
  rays.dir_y[i] = ray.dir_y;
  rays.dir_z[i] = ray.dir_z;
  rays.tnear[i] = ray.tnear;
  rays.tfar[i] = ray.tfar;
  rays.mask[i] = ray.mask;
}

// `points` lifted off their surfaces to the side of `towards`, in place.
void lift_packet(PointPacket& points, const PointPacket& towards, float lift) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    const float side = (towards.x[i] - points.x[i]) * points.normal_x[i] +
                       (towards.y[i] - points.y[i]) * points.normal_y[i] +
                       (towards.z[i] - points.z[i]) * points.normal_z[i];
    const float by = side < 0 ? -lift : lift;
    points.x[i] += by * points.normal_x[i];
    points.y[i] += by * points.normal_y[i];
    points.z[i] += by * points.normal_z[i];
  }
}

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// What a geometry's filter needs.
struct FilterData {
  const SurfaceResolver* resolver;
  std::uint32_t instance;
};

// Lets rays through the holes of cut-out materials.
void skip_holes(const RTCFilterFunctionNArguments* args) {
  const auto& data = *static_cast<const FilterData*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const Hit hit{data.instance, RTCHitN_primID(args->hit, args->N, i),
                  static_cast<double>(RTCHitN_u(args->hit, args->N, i)),
                  static_cast<double>(RTCHitN_v(args->hit, args->N, i)), 0};
    if (data.resolver->is_hole(hit)) args->valid[i] = 0;
  }
}

}  // namespace

struct Tracer::Impl {
  explicit Impl(const scene::Scene& scene);

  void add(const scene::Instance& instance, FilterData& filter_data);
  // A surface point moved to the side of `towards`; a light source stays.
  Vec3 lifted(Vec3 point, Vec3 normal, Vec3 towards) const {
    return point + (dot(normal, towards) < 0 ? -lift : lift) * normal;
  }
  bool occluded(RTCRay ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(embree_scene.get(), &context, &ray);
    return ray.tfar < 0;
  }

  // From one point to the other, both lifted.
  RTCRay between(const SurfacePoint& a, const SurfacePoint& b) const {
    const Vec3 start = lifted(a.position, a.normal, b.position - a.position);
    const Vec3 end = lifted(b.position, b.normal, a.position - b.position), d = end - start;
    const auto share = [&](Vec3 normal) {
      return normal == Vec3{} ? static_cast<float>(near / length(d)) : 0;
    };
    return make_ray(start, d, share(a.normal), 1 - share(b.normal));
  }
  std::uint32_t occluded_packet(const SurfacePoint& a, std::span<const SurfacePoint> others) const;

  SurfaceResolver resolver;
  double lift, near;
  std::vector<FilterData> filters;  // one per instance, at addresses that Embree keeps
  // One thread builds, so that the same scene gives the same hierarchy everywhere.
  Owned<RTCDevice, DeviceRelease> device{rtcNewDevice("threads=1")};
  Owned<RTCScene, SceneRelease> embree_scene;
};

Tracer::Impl::Impl(const scene::Scene& scene)
    : resolver(scene), lift(kLift * scene.radius), near(kNear * scene.radius) {
  if (scene.triangle_count() == 0) throw Error(ErrorCode::mesh_invalid, "the scene has no triangle to trace");
  if (!device) require_success(nullptr);
  embree_scene.reset(rtcNewScene(device.get()));
  rtcSetSceneFlags(embree_scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(embree_scene.get(), RTC_BUILD_QUALITY_HIGH);
  filters.reserve(scene.instances.size());
  for (const scene::Instance& instance : scene.instances) {
    filters.push_back({&resolver, static_cast<std::uint32_t>(filters.size())});
    if (instance.indices.size() >= 3) add(instance, filters.back());
  }
  rtcCommitScene(embree_scene.get());
  require_success(device.get());
}

void Tracer::Impl::add(const scene::Instance& instance, FilterData& filter_data) {
  const Owned<RTCGeometry, GeometryRelease> geometry(
      rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  static_assert(offsetof(scene::Vertex, position) == 0 && sizeof(scene::Vertex) >= 16,
                "Embree reads 16 bytes from each vertex");
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             instance.vertices.data(), 0, sizeof(scene::Vertex), instance.vertices.size());
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             instance.indices.data(), 0, 3 * sizeof(std::uint32_t),
                             instance.indices.size() / 3);
  if (resolver.has_holes(instance)) {
    rtcSetGeometryUserData(geometry.get(), &filter_data);
    rtcSetGeometryIntersectFilterFunction(geometry.get(), skip_holes);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), skip_holes);
  }
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(embree_scene.get(), geometry.get(), filter_data.instance);
  require_success(device.get());
}

std::uint32_t Tracer::Impl::occluded_packet(const SurfacePoint& a,
                                            std::span<const SurfacePoint> others) const {
  alignas(64) int valid[kPacket] = {};
  RTCRay16 rays{};
  for (std::size_t i = 0; i < others.size(); ++i) {
    valid[i] = -1;
    put(rays, i, between(a, others[i]));
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(valid, embree_scene.get(), &context, &rays);
  std::uint32_t hidden = 0;
  for (std::size_t i = 0; i < others.size(); ++i) hidden |= static_cast<std::uint32_t>(rays.tfar[i] < 0) << i;
  return hidden;
}

Tracer::Tracer(const scene::Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
Tracer::~Tracer() = default;

std::optional<Hit> Tracer::intersect(Vec3 origin, Vec3 direction, double nearest, const Hit* self) const {
  float beyond = static_cast<float>(nearest);
  for (;;) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{make_ray(origin, direction, beyond, kInfinity), {}};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(impl_->embree_scene.get(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const bool is_self =
        self != nullptr && self->instance == ray.hit.geomID && self->triangle == ray.hit.primID;
    if (!is_self)
      return Hit{ray.hit.geomID, ray.hit.primID, static_cast<double>(ray.hit.u),
                 static_cast<double>(ray.hit.v), static_cast<double>(ray.ray.tfar)};
    beyond = std::nextafter(ray.ray.tfar, kInfinity);
  }
}

bool Tracer::occluded(Vec3 a, Vec3 normal_a, Vec3 b, Vec3 normal_b) const {
  return impl_->occluded(impl_->between({a, normal_a}, {b, normal_b}));
}

std::uint32_t Tracer::occluded(const SurfacePoint& a, std::span<const SurfacePoint> others) const {
  std::uint32_t hidden = 0;
  for (std::size_t first = 0; first < others.size(); first += kPacket)
    hidden |= impl_->occluded_packet(a, others.subspan(first, std::min(kPacket, others.size() - first)))
              << first;
  return hidden;
}

std::uint32_t Tracer::occluded(const PointPacket& a, const PointPacket& b, std::uint32_t active) const {
  PointPacket start = a, end = b;
  lift_packet(start, b, static_cast<float>(impl_->lift));
  lift_packet(end, a, static_cast<float>(impl_->lift));
  alignas(64) int valid[kPacket];
  RTCRay16 rays;
  for (std::size_t i = 0; i < kPacket; ++i) {
    valid[i] = (active >> i & 1U) != 0 ? -1 : 0;
    rays.org_x[i] = start.x[i], rays.org_y[i] = start.y[i], rays.org_z[i] = start.z[i];
    rays.dir_x[i] = end.x[i] - start.x[i];
    rays.dir_y[i] = end.y[i] - start.y[i];
    rays.dir_z[i] = end.z[i] - start.z[i];
    rays.tnear[i] = 0, rays.tfar[i] = 1, rays.time[i] = 0;
    rays.mask[i] = ~0U, rays.id[i] = 0, rays.flags[i] = 0;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid, impl_->embree_scene.get(), &context, &rays);
  std::uint32_t hidden = 0;
  for (std::size_t i = 0; i < kPacket; ++i) hidden |= static_cast<std::uint32_t>(rays.tfar[i] < 0) << i;
  return hidden & active;
}

bool Tracer::occluded_to_infinity(Vec3 a, Vec3 normal_a, Vec3 direction) const {
  return impl_->occluded(make_ray(impl_->lifted(a, normal_a, direction), direction, 0, kInfinity));
}

interop::Surface Tracer::surface(const Hit& hit, Vec3 towards) const {
  return impl_->resolver.surface(hit, towards);
}

}  // namespace vsgl::trace
