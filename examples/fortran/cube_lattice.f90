! SPDX-License-Identifier: MIT
! cube_lattice BEFORE AFTER
!
! The mesh of examples/c/cube_lattice.c, made in memory: n x n x n cubes, each cut into six tets, with
! inner points out of place, two materials and a temperature at the points. Improves it, takes the
! arrays back, and prints how many bad tets are left. Both meshes are saved.
program cube_lattice
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use tetmend
  implicit none
  integer, parameter :: n = 8
  integer, parameter :: ways(3, 6) = reshape([1, 2, 3, 1, 3, 2, 2, 1, 3, 2, 3, 1, 3, 1, 2, 3, 2, 1], &
                                             [3, 6])
  type(tetmend_mesh) :: mesh
  type(tetmend_statistics) :: before, after
  real(c_double) :: xyz(3, (n + 1)**3), temperatures(1, (n + 1)**3)
  integer(c_int32_t) :: tets(4, 6 * n**3), materials(6 * n**3), map((n + 1)**3)
  real(c_double), allocatable :: now(:, :), values(:, :)
  integer(c_int32_t), allocatable :: tets_now(:, :), materials_now(:)
  character(len=4096) :: files(2)
  integer(c_int64_t) :: state
  integer :: i

  if (command_argument_count() /= 2) then
    write (error_unit, '(a)') 'usage: cube_lattice BEFORE AFTER'
    stop 2
  end if
  do i = 1, 2
    call get_command_argument(i, files(i))
  end do
  call make_points()
  call make_tets()
  call check(mesh%create())
  call check(mesh%set_points(xyz))
  call check(mesh%set_tets(tets, materials))
  call check(mesh%save(files(1)))
  call check(mesh%set_data(tetmend_points, 'temperature', temperatures))
  call check(mesh%improve())
  call check(mesh%get_statistics(before, after))
  print '(a, 2(1x, i8))', 'tets     ', before%tets, after%tets
  print '(a, 2(1x, f8.4))', 'theta_min', before%theta_min, after%theta_min
  print '(a, 2(1x, f8.4))', 'theta_max', before%theta_max, after%theta_max
  print '(a, 2(1x, i8))', 'bad tets ', before%n_bad, after%n_bad
  call check(mesh%get_points(now))
  call check(mesh%get_tets(tets_now, materials_now))
  call check(mesh%get_data(tetmend_points, 'temperature', values))
  call check(mesh%get_vertex_map(map))
  ! Data are linear in the mesh, and points of the surface stay where they were.
  if (any(abs(values(1, :) - (300 + 2 * now(1, :))) > 1e-9) .or. minval(tets_now) /= 1 .or. &
      maxval(tets_now) /= size(now, 2) .or. any(map(:(n + 1)**2) == 0)) then
    call give_up('the arrays are not as promised')
  end if
  if (any(now(:, map(:(n + 1)**2)) /= xyz(:, :(n + 1)**2))) call give_up('the surface has moved')
  call check(mesh%save(files(2)))
  call mesh%destroy()

contains

  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status /= tetmend_ok) call give_up(mesh%last_error())
  end subroutine

  subroutine give_up(reason)
    character(len=*), intent(in) :: reason
    write (error_unit, '(2a)') 'cube_lattice: ', reason
    call mesh%destroy()
    stop 1
  end subroutine

  function number(x, y, z)
    integer, intent(in) :: x, y, z
    integer :: number
    number = (z * (n + 1) + y) * (n + 1) + x + 1
  end function

  ! From -0.2 to 0.2, the same on every machine.
  function jitter()
    real(c_double) :: jitter
    state = modulo(state * 1103515245_c_int64_t + 12345_c_int64_t, 2147483648_c_int64_t)
    jitter = 0.4_c_double * real(state / 65536_c_int64_t, c_double) / 32768 - 0.2_c_double
  end function

  subroutine make_points()
    integer :: x, y, z, i, axis
    logical :: inner
    state = 1
    do z = 0, n
      do y = 0, n
        do x = 0, n
          i = number(x, y, z)
          inner = all([x, y, z] > 0 .and. [x, y, z] < n) .and. x /= n / 2
          xyz(:, i) = [x, y, z]
          do axis = 1, 3
            if (inner) xyz(axis, i) = xyz(axis, i) + jitter()
          end do
          temperatures(1, i) = 300 + 2 * xyz(1, i)
        end do
      end do
    end do
  end subroutine

  ! The six ways from one corner of a cube to the opposite one, an edge at a time.
  subroutine make_tets()
    integer :: x, y, z, way, step, t, corner(3)
    t = 0
    do z = 0, n - 1
      do y = 0, n - 1
        do x = 0, n - 1
          do way = 1, 6
            t = t + 1
            corner = [x, y, z]
            tets(1, t) = number(x, y, z)
            do step = 1, 3
              corner(ways(step, way)) = corner(ways(step, way)) + 1
              tets(step + 1, t) = number(corner(1), corner(2), corner(3))
            end do
            materials(t) = merge(1, 2, x < n / 2)
          end do
        end do
      end do
    end do
  end subroutine
end program
