! SPDX-License-Identifier: MIT
! improve_file IN OUT [OPTION VALUE]...
!
! Improves the mesh of a file, and prints the figures that the command line prints.
program improve_file
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use tetmend
  implicit none
  type(tetmend_mesh) :: mesh
  type(tetmend_statistics) :: before, after
  integer :: k

  if (command_argument_count() < 2 .or. mod(command_argument_count(), 2) /= 0) then
    write (error_unit, '(a)') 'usage: improve_file IN OUT [OPTION VALUE]...'
    stop 2
  end if
  call check(mesh%create())
  do k = 3, command_argument_count(), 2
    call check(mesh%set(argument(k), argument(k + 1)))
  end do
  call check(mesh%load(argument(1)))
  call check(mesh%improve())
  call check(mesh%get_statistics(before, after))
  call print_count('tets', before%tets, after%tets)
  call print_count('points', before%vertices, after%vertices)
  call print_count('boundary triangles', before%boundary_triangles, after%boundary_triangles)
  call print_figure('theta_min, degrees', before%theta_min, after%theta_min)
  call print_figure('theta_max, degrees', before%theta_max, after%theta_max)
  call print_figure('lambda %', before%lambda, after%lambda)
  call print_figure('q_worst', before%q_worst, after%q_worst)
  call print_count('bad tets', before%n_bad, after%n_bad)
  do k = 1, mesh%note_count()
    print '(a)', mesh%note(k)
  end do
  call check(mesh%save(argument(2)))
  call mesh%destroy()

contains

  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status == tetmend_ok) return
    write (error_unit, '(2a)') 'improve_file: ', mesh%last_error()
    call mesh%destroy()
    stop 1
  end subroutine

  function argument(i) result(text)
    integer, intent(in) :: i
    character(len=:), allocatable :: text
    integer :: length
    call get_command_argument(i, length=length)
    allocate (character(len=length) :: text)
    call get_command_argument(i, text)
  end function

  subroutine print_count(name, before, after)
    character(len=*), intent(in) :: name
    integer(c_size_t), intent(in) :: before, after
    character(len=22) :: field
    field = name
    print '(a, 2(1x, i14))', field, before, after
  end subroutine

  subroutine print_figure(name, before, after)
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: before, after
    character(len=22) :: field
    field = name
    print '(a, 2(1x, f14.4))', field, before, after
  end subroutine
end program
