/* The one function that you write: triangles with colours in, an 8-bit image out. C or C++. */
#ifndef IMAGE_H
#define IMAGE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  float position[4]; /* clip coordinates x, y, z, w with w > 0 and 0 <= z <= w */
  float color[3];    /* red, green, blue; 0 to 1 */
} image_vertex;

typedef struct {
  image_vertex vertex[3];
} image_triangle;

/* Draws all triangles into `rgba`, an image of width × height × 4 bytes that is all 0.
 *
 * x/w and y/w of -1 to 1 map to the image's width and height. y = -1 is row 0, the top, and a
 * pixel's sample is its centre. At each pixel the triangle of least z/w is seen, the first of
 * equals; the depth buffer begins so far away that z/w = 1 is drawn. Both sides of a triangle are
 * drawn. Triangles may reach beyond the image's left, right, top and bottom.
 *
 * Colours are interpolated over the triangle with perspective, without lighting, blending,
 * dithering or gamma, and rounded to bytes: 1 becomes 255. Alpha is ignored. */
void draw_image(const image_triangle* triangles, uint32_t count, uint32_t width, uint32_t height,
                uint8_t* rgba);

#ifdef __cplusplus
}
#endif

#endif
