/* Says what is wrong with the records of one triangle; returns the number of faults. */
static int check(int triangle, const uint32_t *records) {
  int faults = 0;
  for (size_t i = 0; i < sizeof samples / sizeof *samples; ++i) {
    const struct sample *s = &samples[i];
    if (s->triangle != triangle) continue;
    const uint32_t count = records[s->at];
    if (count < s->least || count > s->most) {
      printf("triangle %d, pixel (%d, %d), sample %d: drawn %u times, must be %u to %u\n",
             s->triangle, s->x, s->y, s->sample, count, s->least, s->most);
      ++faults;
    }
    for (uint32_t k = 0; count > 0 && k < s->values; ++k) {
      const struct value *v = &values[s->first_value + k];
      float drawn;
      memcpy(&drawn, &records[s->at + v->word], sizeof drawn);
      if (drawn >= v->least && drawn <= v->greatest) continue;
      printf("triangle %d, pixel (%d, %d), sample %d: %s is %.9g, must be %.9g to %.9g\n",
             s->triangle, s->x, s->y, s->sample, v->name, drawn, v->least, v->greatest);
      ++faults;
    }
  }
  return faults;
}

static void give_up(const char *why) {
  fprintf(stderr, "%s\n", why);
  exit(2);
}

/* On a coarser grid than the test was made for, other drawings may be right. */
static void check_grid(int subpixel_bits) {
  if (subpixel_bits >= SUBPIXEL_BITS) return;
  give_up("this driver has fewer subpixel bits than the test was made for");
}
