// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/video/scene.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include <GL/gl.h>
#include <GL/glext.h>
#include <fmt/format.h>

#include "analysis/video/gl_context.h"
#include "analysis/video/meshes.h"
#include "analysis/video/texture_colour.h"
#include "core/robot/kinematics.h"
#include "core/robot_files/mesh.h"

namespace scoria::analysis {
namespace {

using Mat4f = Eigen::Matrix4f;

constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 vertex_colour;
uniform mat4 model, view_projection;
out vec3 world, world_normal, tint;
void main() {
  tint = vertex_colour;
  vec4 p = model * vec4(position, 1.0);
  world = p.xyz;
  world_normal = mat3(transpose(inverse(model))) * normal;
  gl_Position = view_projection * p;
})";

// The ground carries a half-metre grid, darker steep places and a soft shadow below the robot.
constexpr const char* kFragmentShader = R"(#version 330 core
in vec3 world, world_normal, tint;
uniform vec3 colour, eye;
uniform vec4 robot;       // x, y, cos yaw, sin yaw
uniform int is_ground;
out vec4 pixel;
void main() {
  vec3 n = normalize(world_normal);
  vec3 base = colour * tint;
  float shade = 1.0;
  if (is_ground == 1) {
    vec2 cell = abs(fract(world.xy * 2.0 + 0.5) - 0.5);
    float line = smoothstep(0.0, 0.03, min(cell.x, cell.y));
    base *= mix(0.82, 1.0, line) * (0.55 + 0.45 * n.z);
    vec2 d = world.xy - robot.xy;
    vec2 b = vec2(robot.z * d.x + robot.w * d.y, -robot.w * d.x + robot.z * d.y) / vec2(0.34, 0.20);
    shade = 1.0 - 0.5 * exp(-dot(b, b));
  }
  float sun = max(dot(n, normalize(vec3(0.45, 0.35, 0.8))), 0.0);
  float sky = 0.5 + 0.5 * n.z;
  vec3 lit = base * shade * (0.25 * sky + 0.85 * sun);
  float fog = 1.0 - exp(-pow(distance(world, eye) / 9.0, 3.0));
  pixel = vec4(mix(lit, vec3(0.80, 0.83, 0.86), fog), 1.0);
})";

/// The OpenGL functions in use, looked up once per context.
struct Gl {
#define SCORIA_GL(type, name) type name = reinterpret_cast<type>(GlContext::Function("gl" #name))
  SCORIA_GL(PFNGLCREATESHADERPROC, CreateShader);
  SCORIA_GL(PFNGLSHADERSOURCEPROC, ShaderSource);
  SCORIA_GL(PFNGLCOMPILESHADERPROC, CompileShader);
  SCORIA_GL(PFNGLGETSHADERIVPROC, GetShaderiv);
  SCORIA_GL(PFNGLCREATEPROGRAMPROC, CreateProgram);
  SCORIA_GL(PFNGLATTACHSHADERPROC, AttachShader);
  SCORIA_GL(PFNGLLINKPROGRAMPROC, LinkProgram);
  SCORIA_GL(PFNGLUSEPROGRAMPROC, UseProgram);
  SCORIA_GL(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays);
  SCORIA_GL(PFNGLBINDVERTEXARRAYPROC, BindVertexArray);
  SCORIA_GL(PFNGLGENBUFFERSPROC, GenBuffers);
  SCORIA_GL(PFNGLBINDBUFFERPROC, BindBuffer);
  SCORIA_GL(PFNGLBUFFERDATAPROC, BufferData);
  SCORIA_GL(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer);
  SCORIA_GL(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray);
  SCORIA_GL(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation);
  SCORIA_GL(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv);
  SCORIA_GL(PFNGLUNIFORM3FPROC, Uniform3f);
  SCORIA_GL(PFNGLUNIFORM4FPROC, Uniform4f);
  SCORIA_GL(PFNGLUNIFORM1IPROC, Uniform1i);
  SCORIA_GL(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers);
  SCORIA_GL(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer);
  SCORIA_GL(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers);
  SCORIA_GL(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer);
  SCORIA_GL(PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC, RenderbufferStorageMultisample);
  SCORIA_GL(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer);
  SCORIA_GL(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer);
#undef SCORIA_GL
};

/// A mesh on the (software) graphics card.
struct GpuMesh {
  GLuint vertex_array = 0, vertex_buffer = 0, index_buffer = 0;
  GLsizei count = 0;
};

Mat4f Transform(const Mat3& R, const Vec3& p, const Vec3& scale) {
  Mat4f m = Mat4f::Identity();
  m.topLeftCorner<3, 3>() = (R * scale.asDiagonal()).cast<float>();
  m.topRightCorner<3, 1>() = p.cast<float>();
  return m;
}

Mat4f Perspective(double aspect) {
  constexpr double kFieldOfView_rad = 0.75, kNear_m = 0.05, kFar_m = 40.0;
  const double f = 1.0 / std::tan(0.5 * kFieldOfView_rad);
  Mat4f m = Mat4f::Zero();
  m(0, 0) = static_cast<float>(f / aspect);
  m(1, 1) = static_cast<float>(f);
  m(2, 2) = static_cast<float>((kFar_m + kNear_m) / (kNear_m - kFar_m));
  m(2, 3) = static_cast<float>(2.0 * kFar_m * kNear_m / (kNear_m - kFar_m));
  m(3, 2) = -1.0f;
  return m;
}

Mat4f LookAt(const Vec3& eye, const Vec3& at) {
  const Vec3 forward = (at - eye).normalized(), side = forward.cross(Vec3::UnitZ()).normalized();
  Mat3 R;
  R.row(0) = side.transpose();
  R.row(1) = side.cross(forward).transpose();
  R.row(2) = -forward.transpose();
  return Transform(R, -R * eye, Vec3::Ones());
}

}  // namespace

struct Scene::Impl {
  Impl(const core::RobotDescription& robot_in, const terrains::Heightfield& ground_in, int width,
       int height)
      : robot(robot_in),
        ground(ground_in),
        width_px(width),
        height_px(height),
        context(width, height) {
    program = BuildProgram();
    gl.UseProgram(program);
    box = Upload(MakeUnitBox());
    cylinder = Upload(MakeUnitCylinder());
    sphere = Upload(MakeUnitSphere());
    BuildMultisampling();
    glEnable(GL_DEPTH_TEST);
    glViewport(0, 0, width, height);
  }

  GLuint BuildProgram() {
    const GLuint id = gl.CreateProgram();
    for (const auto& [kind, source] : {std::pair{GL_VERTEX_SHADER, kVertexShader},
                                       std::pair{GL_FRAGMENT_SHADER, kFragmentShader}}) {
      const GLuint shader = gl.CreateShader(static_cast<GLenum>(kind));
      gl.ShaderSource(shader, 1, &source, nullptr);
      gl.CompileShader(shader);
      GLint ok = 0;
      gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
      if (ok == 0) throw std::runtime_error("video: a shader does not compile");
      gl.AttachShader(id, shader);
    }
    gl.LinkProgram(id);
    return id;
  }

  void BuildMultisampling() {
    constexpr GLsizei kSamples = 4;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    const auto attach = [&](GLenum format, GLenum where) {
      GLuint buffer = 0;
      gl.GenRenderbuffers(1, &buffer);
      gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
      gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, kSamples, format, width_px, height_px);
      gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, where, GL_RENDERBUFFER, buffer);
    };
    attach(GL_RGBA8, GL_COLOR_ATTACHMENT0);
    attach(GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
  }

  GpuMesh Upload(const MeshData& data, GpuMesh mesh = {}) {
    if (mesh.vertex_array == 0) {
      gl.GenVertexArrays(1, &mesh.vertex_array);
      gl.GenBuffers(1, &mesh.vertex_buffer);
      gl.GenBuffers(1, &mesh.index_buffer);
    }
    mesh.count = static_cast<GLsizei>(data.indices.size());
    gl.BindVertexArray(mesh.vertex_array);
    gl.BindBuffer(GL_ARRAY_BUFFER, mesh.vertex_buffer);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.vertices.size() * sizeof(float)),
                  data.vertices.data(), GL_STATIC_DRAW);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.index_buffer);
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                  static_cast<GLsizeiptr>(data.indices.size() * sizeof(std::uint32_t)),
                  data.indices.data(), GL_STATIC_DRAW);
    constexpr GLsizei kStride = MeshData::kFloatsPerVertex * sizeof(float);
    for (GLuint attribute = 0; attribute < 3; ++attribute) {
      gl.VertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, kStride,
                             reinterpret_cast<const void*>(3 * sizeof(float) * attribute));
      gl.EnableVertexAttribArray(attribute);
    }
    return mesh;
  }

  void UpdateGround(const Vec2& centre) {
    constexpr double kHalf_m = 6.4, kSpacing_m = 0.08, kMove_m = 1.5;
    if (patch.count > 0 && (centre - patch_centre).norm() < kMove_m) return;
    patch_centre = centre;
    patch = Upload(MakeGroundPatch(ground, centre, kHalf_m, kSpacing_m), patch);
  }

  void DrawMesh(const GpuMesh& mesh, const Mat4f& model, const Colour& colour,
                bool is_ground = false) {
    gl.UniformMatrix4fv(gl.GetUniformLocation(program, "model"), 1, GL_FALSE, model.data());
    gl.Uniform3f(gl.GetUniformLocation(program, "colour"), colour[0], colour[1], colour[2]);
    gl.Uniform1i(gl.GetUniformLocation(program, "is_ground"), is_ground ? 1 : 0);
    gl.BindVertexArray(mesh.vertex_array);
    glDrawElements(GL_TRIANGLES, mesh.count, GL_UNSIGNED_INT, nullptr);
  }

  void DrawRobot(const Frame& frame) {
    const auto poses = core::CalcLinkPoses(robot, frame.p_WB, frame.R_WB, frame.q);
    for (const core::Shape& shape : robot.visuals) {
      const core::LinkPose& pose = poses[static_cast<std::size_t>(shape.body)];
      const Mat3 R = pose.R_WL * shape.R_LG;
      const Vec3 p = pose.p_WL + pose.R_WL * shape.p_LG, &s = shape.size_m;
      switch (shape.kind) {
        case core::Shape::Kind::kBox:
          DrawMesh(box, Transform(R, p, s), shape.colour);
          break;
        case core::Shape::Kind::kCylinder:
          DrawMesh(cylinder, Transform(R, p, {s.x(), s.x(), s.y()}), shape.colour);
          break;
        case core::Shape::Kind::kSphere:
          DrawMesh(sphere, Transform(R, p, Vec3::Constant(s.x())), shape.colour);
          break;
        case core::Shape::Kind::kMesh:
          DrawMesh(LinkMesh(shape), Transform(R, p, Vec3::Ones()), {1.0f, 1.0f, 1.0f});
          break;
        case core::Shape::Kind::kHull:  // collides only
          break;
      }
    }
  }

  /// A mesh of the robot, read once, in its own colours; in the shape's where it has none. Nothing
  /// where the file is gone.
  const GpuMesh& LinkMesh(const core::Shape& shape) {
    const auto key = fmt::format("{} {} {}", shape.mesh.string(), fmt::join(shape.size_m, " "),
                                 fmt::join(shape.colour, " "));
    const auto [it, is_new] = link_meshes.try_emplace(key);
    if (!is_new) return it->second;
    MeshData data;
    if (const auto mesh = core::LoadMesh(shape.mesh, shape.size_m)) {
      std::size_t i = 0;
      for (const core::MeshPart& part : mesh->parts) {
        const Vec3 colour = ColourOf(part, shape);
        for (const std::size_t end = i + part.num_points; i < end; ++i)
          data.AddVertex(mesh->points[i], mesh->normals[i], colour);
      }
      data.indices = mesh->triangles;
    }
    it->second = Upload(data, {});
    return it->second;
  }

  Vec3 ColourOf(const core::MeshPart& part, const core::Shape& shape) {
    const auto [texture, is_new] = texture_colours.try_emplace(part.texture);
    if (is_new) texture->second = MeanColour(part.texture);
    if (texture->second) return *texture->second;
    const Colour colour = part.colour.value_or(shape.colour);
    return {colour[0], colour[1], colour[2]};
  }

  void DrawStick(const Stick& stick) {
    const Vec3 along = stick.to_W - stick.from_W;
    const double length = along.norm();
    if (length < 1e-4) return;
    const Mat3 R = Quat::FromTwoVectors(Vec3::UnitZ(), along).toRotationMatrix();
    DrawMesh(
        cylinder,
        Transform(R, 0.5 * (stick.from_W + stick.to_W), {stick.radius_m, stick.radius_m, length}),
        stick.colour);
  }

  const core::RobotDescription& robot;
  const terrains::Heightfield& ground;
  int width_px, height_px;
  GlContext context;
  Gl gl;
  GLuint program = 0, framebuffer = 0;
  GpuMesh box, cylinder, sphere, patch;
  std::map<std::string, GpuMesh> link_meshes;
  std::map<std::filesystem::path, std::optional<Vec3>> texture_colours;
  Vec2 patch_centre = Vec2::Zero();
};

Scene::Scene(const core::RobotDescription& robot, const terrains::Heightfield& ground, int width_px,
             int height_px)
    : impl_(std::make_unique<Impl>(robot, ground, width_px, height_px)) {}

Scene::~Scene() = default;

const std::uint8_t* Scene::Draw(const Frame& frame) {
  Impl& s = *impl_;
  s.UpdateGround(frame.p_WB.head<2>());
  s.gl.BindFramebuffer(GL_FRAMEBUFFER, s.framebuffer);
  glClearColor(0.80f, 0.83f, 0.86f, 1.0f);
  glClear(static_cast<GLbitfield>(GL_COLOR_BUFFER_BIT) |
          static_cast<GLbitfield>(GL_DEPTH_BUFFER_BIT));
  const Mat4f view_projection = Perspective(static_cast<double>(s.width_px) / s.height_px) *
                                LookAt(frame.eye_W, frame.look_at_W);
  s.gl.UniformMatrix4fv(s.gl.GetUniformLocation(s.program, "view_projection"), 1, GL_FALSE,
                        view_projection.data());
  const Eigen::Vector3f eye = frame.eye_W.cast<float>();
  s.gl.Uniform3f(s.gl.GetUniformLocation(s.program, "eye"), eye.x(), eye.y(), eye.z());
  const double yaw = std::atan2(frame.R_WB(1, 0), frame.R_WB(0, 0));
  s.gl.Uniform4f(s.gl.GetUniformLocation(s.program, "robot"), static_cast<float>(frame.p_WB.x()),
                 static_cast<float>(frame.p_WB.y()), static_cast<float>(std::cos(yaw)),
                 static_cast<float>(std::sin(yaw)));
  constexpr Colour kAsItIs = {0.8f, 0.75f, 0.72f};
  s.DrawMesh(s.patch, Mat4f::Identity(), kAsItIs, true);
  s.DrawRobot(frame);
  for (const Stick& stick : frame.sticks) s.DrawStick(stick);
  for (const Ball& ball : frame.balls) {
    s.DrawMesh(s.sphere, Transform(Mat3::Identity(), ball.p_W, Vec3::Constant(ball.radius_m)),
               ball.colour);
  }
  s.gl.BindFramebuffer(GL_READ_FRAMEBUFFER, s.framebuffer);
  s.gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  s.gl.BlitFramebuffer(0, 0, s.width_px, s.height_px, 0, 0, s.width_px, s.height_px,
                       GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glFinish();
  return s.context.Pixels();
}

}  // namespace scoria::analysis
