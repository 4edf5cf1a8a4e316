/*
 * SDL 2's software renderer, by SDL_RenderGeometryRaw(): triangles with a colour at each vertex,
 * into a surface. It has neither depth nor perspective.
 */
#include <SDL2/SDL.h>
#include <stdlib.h>

#include "image.h"

static uint8_t byte_of(float color) { return (uint8_t)(color * 255 + 0.5F); }

static void draw_all(SDL_Renderer* renderer, const image_triangle* triangles, uint32_t count,
                     uint32_t width, uint32_t height) {
  const int corners = (int)(3 * count);
  float* const at = malloc(2 * (size_t)corners * sizeof *at);
  SDL_Color* const colors = malloc((size_t)corners * sizeof *colors);
  for (int i = 0; i < corners && at != NULL && colors != NULL; ++i) {
    const image_vertex* const v = &triangles[i / 3].vertex[i % 3];
    at[2 * i] = (v->position[0] / v->position[3] + 1) / 2 * (float)width;
    at[2 * i + 1] = (v->position[1] / v->position[3] + 1) / 2 * (float)height;
    colors[i].r = byte_of(v->color[0]);
    colors[i].g = byte_of(v->color[1]);
    colors[i].b = byte_of(v->color[2]);
    colors[i].a = 255;
  }
  if (at != NULL && colors != NULL) {
    SDL_RenderGeometryRaw(renderer, NULL, at, 2 * sizeof *at, colors, sizeof *colors, NULL, 0,
                          corners, NULL, 0, 0);
    SDL_RenderFlush(renderer);
  }
  free(at);
  free(colors);
}

void draw_image(const image_triangle* triangles, uint32_t count, uint32_t width, uint32_t height,
                uint8_t* rgba) {
  SDL_Surface* const surface = SDL_CreateRGBSurfaceWithFormatFrom(
      rgba, (int)width, (int)height, 32, (int)(4 * width), SDL_PIXELFORMAT_RGBA32);
  SDL_Renderer* const renderer = surface == NULL ? NULL : SDL_CreateSoftwareRenderer(surface);
  if (renderer != NULL) {
    SDL_SetRenderDrawBlendMode(renderer, SDL_BLENDMODE_NONE);
    draw_all(renderer, triangles, count, width, height);
    SDL_DestroyRenderer(renderer);
  }
  SDL_FreeSurface(surface);
}
