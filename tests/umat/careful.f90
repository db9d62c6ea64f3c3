! Linear elasticity that refuses steps of more than 1e-4 of strain; statev(1) counts accepted steps.
! A compression beyond props(3) it cannot do at all.
      subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, &
                      stran, dstran, time, dtime, temp, dtemp, predef, dpred, cmname, &
                      ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, &
                      celent, dfgrd0, dfgrd1, noel, npt, layer, kspt, kstep, kinc)
      implicit none
      character(len=80) :: cmname
      integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, kstep(4), kinc
      double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl
      double precision :: ddsddt(ntens), drplde(ntens), drpldt, stran(ntens), dstran(ntens)
      double precision :: time(2), dtime, temp, dtemp, predef(1), dpred(1), props(nprops)
      double precision :: coords(3), drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)
      double precision :: shear, lame
      integer :: i
      shear = props(1)/(2.0d0*(1.0d0 + props(2)))
      lame = props(1)*props(2)/((1.0d0 + props(2))*(1.0d0 - 2.0d0*props(2)))
      ddsdde = 0.0d0
      ddsdde(1:3, 1:3) = lame
      do i = 1, 3
        ddsdde(i, i) = lame + 2.0d0*shear
        ddsdde(i + 3, i + 3) = shear
      end do
      if (maxval(abs(dstran)) > 1.0d-4 .or. sum(stran(1:3)) < -props(3)) then
        stress = 1.0d30
        statev = -1.0d0
        pnewdt = 0.5d0
        return
      end if
      stress = stress + matmul(ddsdde, dstran)
      statev(1) = statev(1) + 1.0d0
      end subroutine umat
