/* Linear elasticity that writes down what it was called with. */
void umat_(
    double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd,
    double *rpl, double *ddsddt, double *drplde, double *drpldt, const double *stran,
    const double *dstran, const double *time, const double *dtime, const double *temp,
    const double *dtemp, const double *predef, const double *dpred, const char *cmname,
    const int *ndi, const int *nshr, const int *ntens, const int *nstatv, const double *props,
    const int *nprops, const double *coords, const double *drot, double *pnewdt,
    const double *celent, const double *dfgrd0, const double *dfgrd1, const int *noel,
    const int *npt, const int *layer, const int *kspt, const int *kstep, const int *kinc,
    unsigned long length) {
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
  if (*nstatv < 60) return;
  double *note = statev;
  for (int i = 0; i < 6; ++i) *note++ = stran[i];
  for (int i = 0; i < 6; ++i) *note++ = dstran[i];
  for (int i = 0; i < 9; ++i) *note++ = drot[i];
  for (int i = 0; i < 9; ++i) *note++ = dfgrd1[i] - dfgrd0[i];
  *note++ = time[0], *note++ = time[1], *note++ = *dtime, *note++ = *celent, *note++ = *pnewdt;
  *note++ = *ndi, *note++ = *nshr, *note++ = *ntens, *note++ = *nstatv, *note++ = *nprops;
  *note++ = *noel, *note++ = *npt, *note++ = *layer, *note++ = *kspt, *note++ = kstep[0];
  *note++ = *kinc, *note++ = *temp, *note++ = *dtemp, *note++ = *predef, *note++ = *dpred;
  *note++ = coords[0], *note++ = cmname[0], *note++ = cmname[79], *note++ = (double)length;
}
