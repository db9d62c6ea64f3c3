/* Linear elasticity in C, under the name without underscore. */
void umat(
    double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd,
    double *rpl, double *ddsddt, double *drplde, double *drpldt, const double *stran,
    const double *dstran, const double *time, const double *dtime, const double *temp,
    const double *dtemp, const double *predef, const double *dpred, const char *cmname,
    const int *ndi, const int *nshr, const int *ntens, const int *nstatv, const double *props,
    const int *nprops, const double *coords, const double *drot, double *pnewdt,
    const double *celent, const double *dfgrd0, const double *dfgrd1, const int *noel,
    const int *npt, const int *layer, const int *kspt, const int *kstep, const int *kinc) {
  const double shear = props[0] / (2.0 * (1.0 + props[1]));
  const double lame = props[0] * props[1] / ((1.0 + props[1]) * (1.0 - 2.0 * props[1]));
  for (int i = 0; i < 36; ++i) ddsdde[i] = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) ddsdde[i + 6 * j] = lame;
    ddsdde[7 * i] += 2.0 * shear;
    ddsdde[7 * (i + 3)] = shear;
  }
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) stress[i] += ddsdde[i + 6 * j] * dstran[j];
}
