// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What Python holds: models, meshes, and the bodies made of them, which keep them alive.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <utility>

#include <swiftlet/body.h>
#include <swiftlet/mesh.h>
#include <swiftlet/model.h>

namespace swiftlet::python {

/// A model or mesh, and the file that it is mapped from; never changed once made.
template <class T>
struct Held {
  T value;
  std::string mapped{};
};
using HeldModel = Held<Model>;
using HeldMesh = Held<MeshModel>;

/// A body that shares the ownership of what it is a view of.
class OwnedBody {
 public:
  explicit OwnedBody(const Body& primitive) : body_(primitive) {}
  OwnedBody(std::shared_ptr<const HeldModel> model, double radius)
      : model_(std::move(model)), body_(Body(model_->value, radius)) {}
  OwnedBody(std::shared_ptr<const HeldMesh> mesh, double radius, bool solid)
      : mesh_(std::move(mesh)), body_(solid ? MeshBody::solid(mesh_->value, radius) : MeshBody(mesh_->value, radius)) {}

  bool is_mesh() const { return mesh_ != nullptr; }
  const MeshBody& body() const { return body_; }
  const Body& convex() const { return body_.convex(); }
  const std::shared_ptr<const HeldModel>& model() const { return model_; }
  const std::shared_ptr<const HeldMesh>& mesh() const { return mesh_; }

 private:
  std::shared_ptr<const HeldModel> model_;
  std::shared_ptr<const HeldMesh> mesh_;
  MeshBody body_;
};

/// A Model, a MeshModel or a Body; else TypeError naming `name`.
OwnedBody to_body(pybind11::handle object, const char* name);

void define_bodies(pybind11::module_& module);

}  // namespace swiftlet::python
