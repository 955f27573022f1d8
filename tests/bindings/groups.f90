! SPDX-License-Identifier: MIT
! Groups go in and come out of the Fortran module. Prints "ok".
program groups
  use, intrinsic :: iso_c_binding
  use tetmend
  implicit none
  type(tetmend_mesh) :: mesh
  real(c_double) :: xyz(3, 5)
  integer(c_int) :: place
  integer(c_int32_t) :: number
  integer(c_int32_t), allocatable :: members(:)
  character(len=:), allocatable :: name

  xyz = reshape([0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0, 1d0, 1d0, 1d0], [3, 5])
  call check(mesh%create())
  call check(mesh%set_points(xyz))
  call check(mesh%set_tets(reshape([1, 2, 3, 4, 2, 3, 4, 5], [4, 2]), [7, 8]))
  call check(mesh%set_group(tetmend_points, 0, 'ends', [1, 5]))
  call check(mesh%set_group(tetmend_tets, 8, 'upper'))
  if (mesh%set_group(tetmend_tets, 1, 'wrong', [3]) /= tetmend_wrong_input) error stop 'tet 3 is known'
  if (mesh%last_error() /= 'members[1]: no 3 of the tets, there are 2, counted from 1') error stop 'no place'
  call check(mesh%improve())
  if (mesh%group_count() /= 2) error stop 'the count is wrong'
  call check(mesh%get_group(1, place, number, name, members))
  if (place /= tetmend_points .or. number /= 0 .or. name /= 'ends') error stop 'group 1 is another'
  if (size(members) /= 2 .or. any(members /= [1, 5])) error stop 'group 1 has other members'
  call check(mesh%get_group(2, place, number, name, members))
  if (place /= tetmend_tets .or. number /= 8 .or. name /= 'upper') error stop 'group 2 is another'
  if (size(members) /= 1) error stop 'group 2 has other members'
  call mesh%destroy()
  print '(a)', 'ok'

contains

  subroutine check(status)
    integer, intent(in) :: status
    if (status == tetmend_ok) return
    print '(a)', mesh%last_error()
    error stop 1
  end subroutine
end program
