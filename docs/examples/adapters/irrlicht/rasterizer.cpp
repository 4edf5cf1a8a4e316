/*
 * Irrlicht's software renderer, Burning's Video: triangles with a colour at each vertex, into a
 * screenshot. Its vertices have no w, so perspective is out of reach.
 */
#include <irrlicht/irrlicht.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "image.h"

namespace {

using irr::video::IVideoDriver;
using irr::video::S3DVertex;

irr::u32 byte_of(float color) { return static_cast<irr::u32>(std::floor(color * 255 + 0.5F)); }

/* Irrlicht's y points up, the image's down. Depth 0.5 lies between the near and far planes. */
S3DVertex vertex_of(const image_vertex& v) {
  const float w = v.position[3];
  const irr::video::SColor color(255, byte_of(v.color[0]), byte_of(v.color[1]),
                                 byte_of(v.color[2]));
  return S3DVertex(v.position[0] / w, -v.position[1] / w, 0.5F, 0, 0, -1, color, 0, 0);
}

void draw_all(IVideoDriver& driver, const image_triangle* triangles, uint32_t count) {
  std::vector<S3DVertex> vertices;
  std::vector<irr::u16> indices;
  for (uint32_t t = 0; t < count; ++t) {
    for (const image_vertex& vertex : triangles[t].vertex) {
      indices.push_back(static_cast<irr::u16>(vertices.size()));
      vertices.push_back(vertex_of(vertex));
    }
  }
  irr::video::SMaterial material;
  material.Lighting = false;
  material.BackfaceCulling = false;
  material.ZBuffer = irr::video::ECFN_ALWAYS;
  driver.setMaterial(material);
  for (const auto state :
       {irr::video::ETS_WORLD, irr::video::ETS_VIEW, irr::video::ETS_PROJECTION}) {
    driver.setTransform(state, irr::core::IdentityMatrix);
  }
  driver.drawVertexPrimitiveList(vertices.data(), static_cast<irr::u32>(vertices.size()),
                                 indices.data(), count, irr::video::EVT_STANDARD,
                                 irr::scene::EPT_TRIANGLES, irr::video::EIT_16BIT);
}

/* A device that needs no window. endScene() would print the picture, so it is never called. */
irr::IrrlichtDevice* device_of(uint32_t width, uint32_t height) {
  irr::SIrrlichtCreationParameters wanted;
  wanted.DeviceType = irr::EIDT_CONSOLE;
  wanted.DriverType = irr::video::EDT_BURNINGSVIDEO;
  wanted.WindowSize = irr::core::dimension2du(width, height);
  wanted.Bits = 32;
  wanted.LoggingLevel = irr::ELL_NONE;
  return irr::createDeviceEx(wanted);
}

}  // namespace

extern "C" void draw_image(const image_triangle* triangles, uint32_t count, uint32_t width,
                           uint32_t height, uint8_t* rgba) {
  irr::IrrlichtDevice* const device = device_of(width, height);
  if (device == nullptr) return;
  IVideoDriver& driver = *device->getVideoDriver();
  driver.beginScene(true, true, irr::video::SColor(0, 0, 0, 0));
  draw_all(driver, triangles, count);
  if (irr::video::IImage* const shot = driver.createScreenShot()) {
    for (uint32_t i = 0; i < width * height; ++i) {
      const irr::video::SColor color = shot->getPixel(i % width, i / width);
      rgba[4 * i] = static_cast<uint8_t>(color.getRed());
      rgba[4 * i + 1] = static_cast<uint8_t>(color.getGreen());
      rgba[4 * i + 2] = static_cast<uint8_t>(color.getBlue());
      rgba[4 * i + 3] = static_cast<uint8_t>(color.getAlpha());
    }
    shot->drop();
  }
  device->drop();
}
