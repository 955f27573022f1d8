! SPDX-License-Identifier: MIT
! Arrays of the wrong shape are told by the Fortran module, with the shape that is wanted. Prints "ok".
program shapes
  use, intrinsic :: iso_c_binding
  use tetmend
  implicit none
  type(tetmend_mesh) :: mesh
  real(c_double) :: xyz(3, 4)
  integer(c_int32_t) :: tets(4, 1)

  if (mesh%load('part.mesh') /= tetmend_wrong_call) error stop 'there is no handle yet'
  if (mesh%last_error() /= 'the handle is null') error stop 'another message'
  if (mesh%create() /= tetmend_ok) error stop 'out of memory'
  xyz = reshape([0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0], [3, 4])
  tets(:, 1) = [1, 2, 3, 4]
  call expect(mesh%set_points(transpose(xyz)), 'xyz has shape (4, 3), but (3, n) is wanted')
  if (mesh%set_points(xyz) /= tetmend_ok) error stop 'these are points'
  if (mesh%last_error() /= '') error stop 'an old message'
  call expect(mesh%set_tets(transpose(tets)), 'tets has shape (1, 4), but (4, n) is wanted')
  call expect(mesh%set_tets(tets, [1, 2]), 'labels of tets has shape (2), but (1) is wanted')
  call expect(mesh%set_triangles(tets), 'triangles has shape (4, 1), but (3, n) is wanted')
  call expect(mesh%set_edges(tets), 'edges has shape (4, 1), but (2, n) is wanted')
  call expect(mesh%set_point_labels([1]), 'labels of points has shape (1), but (4) is wanted')
  if (mesh%set_tets(tets, [1]) /= tetmend_ok) error stop 'this is a tet'
  call expect(mesh%set_data(tetmend_points, 'heat', reshape([1d0, 2d0], [1, 2])), &
              'data heat has shape (1, 2), but (components, 4) is wanted')
  call expect(mesh%set_data(tetmend_tets, 'part', reshape([1, 2], [1, 2])), &
              'data part has shape (1, 2), but (components, 1) is wanted')
  call mesh%destroy()
  print '(a)', 'ok'

contains

  subroutine expect(status, message)
    integer, intent(in) :: status
    character(len=*), intent(in) :: message
    if (status == tetmend_wrong_call .and. mesh%last_error() == message) return
    print '(i0, 1x, a)', status, mesh%last_error()
    error stop 1
  end subroutine
end program
